// SPDX-License-Identifier: MIT
// URIs of buffers and images: every form of RFC 2397, and files beside the scene.
#include "gltf_draft.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/data_uri.hpp"
#include "lab/scenes/scene_files.hpp"

#include <doctest/doctest.h>

namespace rebound::lab::test {
namespace {

std::string decoded(const std::string& uri) {
    const std::vector<uint8_t> bytes = decodeDataUri(uri, "buffer 7");
    return {bytes.begin(), bytes.end()};
}

std::string errorOf(const std::string& uri) {
    try {
        decodeDataUri(uri, "buffer 7");
    } catch (const InputError& failure) {
        return failure.what();
    }
    return "no error";
}

// By the definition of base64: six bits a character.
std::string base64(const Bytes& bytes) {
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t bit = 0; bit < bytes.size() * 8; bit += 6) {
        size_t value = 0;
        for (size_t i = bit; i < bit + 6; ++i)
            value = value * 2 + (i / 8 < bytes.size() ? (bytes[i / 8] >> (7 - i % 8)) & 1u : 0u);
        text += alphabet[value];
    }
    while (text.size() % 4 != 0) text += '=';
    return text;
}

} // namespace

TEST_CASE("data URIs with any media type, parameters, case and encoding") {
    for (const char* header : {"data:;base64,", "data:application/octet-stream;base64,", "DATA:;BASE64,",
                               "data:image/png;charset=utf-8;base64,", "data:text/plain;a=\"b\";Base64,"}) {
        CAPTURE(header);
        CHECK(isDataUri(header));
        CHECK(decoded(std::string(header) + "aGVsbG8=") == "hello"); // RFC 4648's alphabet
        CHECK(decoded(std::string(header) + "aGVsbG8") == "hello");  // without padding
        CHECK(decoded(std::string(header) + "aGVs\n bG8%3D") == "hello");
        CHECK(decoded(header).empty());
    }
    CHECK(decoded("data:,a%20b%2Cc,d") == "a b,c,d");
    CHECK(decoded("data:text/plain;charset=utf-8,100%") == "100%");
    CHECK(decoded("data:;base64x,aGVs") == "aGVs"); // another parameter
    CHECK(decoded("data:,") == "");
    CHECK_FALSE(isDataUri("data"));
    CHECK_FALSE(isDataUri("database.bin"));
    // RFC 4648, section 10.
    const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                           {"Zg==", "f"},
                                                           {"Zm8=", "fo"},
                                                           {"Zm9v", "foo"},
                                                           {"Zm9vYg==", "foob"},
                                                           {"Zm9vYmE=", "fooba"},
                                                           {"Zm9vYmFy", "foobar"}};
    for (const auto& [text, plain] : vectors) CHECK(decoded(std::string("data:;base64,") + text) == plain);
}

TEST_CASE("damaged data URIs are refused without their data in the sentence") {
    for (const char* uri : {"data:;base64", "data:;base64,aGV$bG8=", "data:;base64,aGVsb",
                            "data:;base64,aG=Vs", "data:;base64,aGVsbG8=x"}) {
        CAPTURE(uri);
        const std::string error = errorOf(uri);
        CHECK(error.find("buffer 7") != std::string::npos);
        CHECK(error.find("data URI") != std::string::npos);
        CHECK(error.find("aG") == std::string::npos);
    }
}

TEST_CASE("buffers and images from data URIs are what they are from files") {
    const Bytes texels = {10, 20, 30, 40, 50, 60, 70, 80};
    const Bytes png = makePng(1, 2, 8, texels);
    for (const char* header :
         {"data:;base64,", "DATA:application/gltf-buffer;BASE64,", "data:;charset=x;base64,"}) {
        CAPTURE(header);
        GltfDraft draft = triangleDraft();
        draft.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
        draft.root["meshes"][0]["primitives"][0]["material"] = 0;
        draft.add("textures", {{"source", 0}});
        draft.add("images", {{"uri", header + base64(png)}});
        draft.root["buffers"] = {
            {{"byteLength", draft.buffer.size()}, {"uri", header + base64(draft.buffer)}}};
        TemporaryFolder folder;
        const Result<Scene> scene = loadGltf(draft.save(folder));
        REQUIRE_MESSAGE(scene, (scene ? "" : scene.error().message));
        CHECK(scene->meshes.at(0).positions == std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        CHECK(scene->textures.at(0).rgba == texels);

        // An image that is no PNG or JPEG is named, not shown.
        draft.root["images"][0]["uri"] =
            header + base64({'R', 'I', 'F', 'F', 1, 2, 3, 4, 'W', 'E', 'B', 'P'});
        const Result<Scene> other = loadGltf(draft.save(folder));
        REQUIRE(!other);
        CHECK(other.error().message.find("image 0 is neither a PNG nor a JPEG file") != std::string::npos);
    }
}

TEST_CASE("other URIs are refused, not taken for names of files") {
    TemporaryFolder folder;
    for (const char* uri : {"https://example.org/a.bin", "file:///tmp/a.bin", "blob:1234"}) {
        CAPTURE(uri);
        GltfDraft draft = triangleDraft();
        draft.root["buffers"] = {{{"byteLength", draft.buffer.size()}, {"uri", uri}}};
        const Result<Scene> scene = loadGltf(draft.save(folder));
        REQUIRE(!scene);
        INFO(scene.error().message);
        CHECK(scene.error().message.find(std::string("buffer 0 has the URI '") + uri +
                                         "'; expected a file") != std::string::npos);
    }
}

} // namespace rebound::lab::test
