// SPDX-License-Identifier: MIT
#include "lab/scenes/scene_files.hpp"

#include "lab/files/input_error.hpp"
#include "lab/gltf/gltf_scene.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace rebound::lab {
namespace {

constexpr std::string_view builtinPrefix = "builtin:";

constexpr std::pair<const char*, Scene (*)()> builtinMakers[] = {{"atrium", makeAtrium},
                                                                 {"cornell", makeCornellBox},
                                                                 {"study", makeStudy},
                                                                 {"street", makeStreet},
                                                                 {"tunnel", makeTunnel}};

Scene makeBuiltin(const std::string& name) {
    for (const auto& [known, make] : builtinMakers)
        if (name == known) return make();
    refuse("there is no built-in scene '" + std::string(builtinPrefix) + name + "'; " + builtinSceneList() +
               " was expected",
           ErrorCode::notFound);
}

template <class T>
T orRefuse(Result<T> result) {
    if (!result) throw InputError(result.error());
    return std::move(*result);
}

std::filesystem::path viewFileBeside(const std::filesystem::path& sceneFile) {
    const std::filesystem::path candidate = sceneFile.parent_path() / "view.json";
    std::error_code failure;
    return std::filesystem::exists(candidate, failure) ? candidate : std::filesystem::path();
}

// From outside the bounding sphere, down a little onto its middle.
CameraView cameraOnAll(const Scene& scene) {
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (const Mesh& mesh : scene.meshes)
        for (const glm::vec3& position : mesh.positions) {
            low = glm::min(low, glm::dvec3(position));
            high = glm::max(high, glm::dvec3(position));
        }
    const glm::dvec3 centre = (low + high) / 2.0;
    const double radius = std::max(glm::length(high - low) / 2.0, 1e-6);
    CameraView camera;
    camera.name = "default";
    camera.verticalFieldOfView = glm::radians(45.0f);
    // In square and wider pictures the sphere touches the upper and lower edges.
    const double distance = radius / std::sin(static_cast<double>(camera.verticalFieldOfView) / 2.0);
    camera.position = glm::vec3(centre + distance * glm::normalize(glm::dvec3(1.0, 0.7, 1.5)));
    camera.target = glm::vec3(centre);
    camera.farPlane = static_cast<float>(distance + 2.0 * radius);
    camera.nearPlane = static_cast<float>((distance - radius) / 2.0);
    return camera;
}

bool isLit(const Scene& scene) {
    const auto isBright = [](const glm::vec3& light) { return light != glm::vec3(0.0f); };
    const auto emits = [&](const Mesh& mesh) {
        return isBright(scene.materials[static_cast<size_t>(mesh.material)].emission);
    };
    return isBright(scene.environment) ||
           std::any_of(scene.lights.begin(), scene.lights.end(),
                       [&](const Light& light) { return isBright(light.intensity); }) ||
           std::any_of(scene.meshes.begin(), scene.meshes.end(), emits);
}

// A view file's moment, changed as asked.
GltfOptions momentOf(GltfOptions options, const SceneMoment& moment) {
    // Another clip's time means nothing to this one.
    if (moment.animation && *moment.animation != options.animation) options.time = 0.0f;
    options.animation = moment.animation.value_or(options.animation);
    options.time = moment.time.value_or(options.time);
    options.animate = options.animate || moment.animation || moment.time;
    options.moved = moment.moved;
    return options;
}

// Moves all meshes of each name.
void moveMeshes(Scene& scene, const std::map<std::string, glm::mat4>& moved) {
    for (const auto& [name, place] : moved) {
        bool isKnown = false;
        for (Mesh& mesh : scene.meshes) {
            if (mesh.name != name) continue;
            isKnown = true;
            for (glm::vec3& position : mesh.positions)
                position = glm::vec3(place * glm::vec4(position, 1.0f));
            for (glm::vec3& normal : mesh.normals) normal = glm::normalize(glm::mat3(place) * normal);
        }
        if (isKnown) continue;
        std::string known;
        for (const Mesh& mesh : scene.meshes) known += (known.empty() ? "'" : ", '") + mesh.name + "'";
        refuse("there is no mesh '" + name + "' to move in the scene; there are " + known,
               ErrorCode::notFound);
    }
}

} // namespace

const std::vector<std::string>& builtinScenes() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& maker : builtinMakers) all.push_back(std::string(builtinPrefix) + maker.first);
        return all;
    }();
    return names;
}

std::string builtinSceneList() {
    const std::vector<std::string>& names = builtinScenes();
    std::string list;
    for (size_t i = 0; i < names.size(); ++i)
        list += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
    return list;
}

struct MovingScene::Source {
    std::string name; // as it was given
    std::optional<ViewFile> view;
    std::optional<GltfScene> gltf;
    Scene builtin; // without gltf

    Scene at(const SceneMoment& moment, bool isLast) {
        Scene scene = gltf ? ofGltf(moment, isLast) : ofBuiltin(moment, isLast);
        if (view) applyViewFile(*view, scene);
        if (scene.cameras.empty() && scene.triangleCount() > 0) scene.cameras.push_back(cameraOnAll(scene));
        return scene;
    }

private:
    Scene ofGltf(const SceneMoment& moment, bool isLast) {
        const GltfOptions options = momentOf(view ? view->animation : GltfOptions{}, moment);
        return orRefuse(isLast ? std::move(*gltf).at(options) : gltf->at(options));
    }

    Scene ofBuiltin(const SceneMoment& moment, bool isLast) {
        if (moment.animation || moment.time)
            refuse("'" + name + "' does not move; a glTF file was expected with a time or an animation",
                   ErrorCode::invalidArgument);
        Scene scene = isLast ? std::move(builtin) : builtin;
        moveMeshes(scene, moment.moved);
        return scene;
    }
};

MovingScene::MovingScene(std::unique_ptr<Source> s) : source(std::move(s)) {}
MovingScene::MovingScene(MovingScene&&) noexcept = default;
MovingScene& MovingScene::operator=(MovingScene&&) noexcept = default;
MovingScene::~MovingScene() = default;

Result<MovingScene> MovingScene::open(const std::string& name, const std::filesystem::path& viewFile) {
    auto source = std::make_unique<Source>();
    source->name = name;
    try {
        if (name.starts_with(builtinPrefix)) {
            source->builtin = makeBuiltin(name.substr(builtinPrefix.size()));
            if (!viewFile.empty()) source->view = orRefuse(readViewFile(viewFile));
        } else {
            const std::filesystem::path view = viewFile.empty() ? viewFileBeside(name) : viewFile;
            if (!view.empty()) source->view = orRefuse(readViewFile(view));
            source->gltf = orRefuse(GltfScene::open(name));
        }
    } catch (const InputError& failure) {
        return failure.error();
    }
    return MovingScene(std::move(source));
}

namespace {

Result<Scene> checked(const std::string& name, Result<Scene> scene) {
    if (!scene) return scene;
    const std::string subject = "'" + name + "': ";
    if (const Result<> valid = validate(*scene); !valid)
        return Error{valid.error().code, subject + valid.error().message};
    if (!isLit(*scene))
        return Error{ErrorCode::invalidData, subject + "no light: the scene has neither lights nor an "
                                                       "environment nor emissive surfaces; a view file "
                                                       "gives it some, such as {\"environment\": {\"type\": "
                                                       "\"constant\", \"radiance\": [1, 1, 1]}}, "
                                                       "as view.json beside the scene or by --view FILE"};
    return scene;
}

template <class Make>
Result<Scene> guarded(Make make) {
    try {
        return make();
    } catch (const InputError& failure) {
        return failure.error();
    }
}

} // namespace

Result<Scene> MovingScene::at(const SceneMoment& moment) & {
    return checked(source->name, guarded([&] { return source->at(moment, false); }));
}

Result<Scene> MovingScene::at(const SceneMoment& moment) && {
    return checked(source->name, guarded([&] { return source->at(moment, true); }));
}

Result<Scene> loadScene(const std::string& fileOrBuiltin, const std::filesystem::path& viewFile,
                        const SceneMoment& moment) {
    auto scene = MovingScene::open(fileOrBuiltin, viewFile);
    if (!scene) return scene.error();
    return std::move(*scene).at(moment);
}

} // namespace rebound::lab
