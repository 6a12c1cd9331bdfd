// SPDX-License-Identifier: MIT
#include "lab/light/reference_cache.hpp"

#include "lab/files/file_bytes.hpp"
#include "lab/files/input_error.hpp"
#include "lab/files/output_file.hpp"

#include <system_error>

namespace rebound::lab {

namespace {

namespace fs = std::filesystem;

constexpr size_t largestFile = size_t(1) << 36; // far more than paths through the largest frame take up

Result<> makeFolder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure)
        return Error{ErrorCode::inputOutput,
                     folder.string() + ": cannot create the folder: " + failure.message()};
    return {};
}

// What cannot be taken up is replaced.
void takeUp(PathTracer& tracer, const fs::path& file) {
    const auto bytes = guardInput(file, [&] { return readFileBytes(file, largestFile, file); });
    if (bytes) static_cast<void>(tracer.restore(std::as_bytes(std::span(*bytes))));
}

} // namespace

Result<PathTracedLight> cachedReference(const Scene& scene, const CameraView& camera,
                                        const PathTracerOptions& options, const fs::path& folder) {
    auto tracer = PathTracer::create(scene, camera, options);
    if (!tracer) return tracer.error();
    if (auto made = makeFolder(folder); !made) return made.error();
    const fs::path file = folder / (pathTracerKey(scene, camera, options) + ".paths");
    takeUp(*tracer, file);
    while (!tracer->isDone()) {
        tracer->addPass();
        if (auto written = writeFile(file, tracer->save()); !written) return written.error();
    }
    return tracer->light();
}

} // namespace rebound::lab
