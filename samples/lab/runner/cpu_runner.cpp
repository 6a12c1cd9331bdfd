// SPDX-License-Identifier: MIT
#include "lab/runner/host_image.hpp"
#include "lab/runner/inspection.hpp"
#include "rebound/techniques/input_check.hpp"

#include <algorithm>
#include <cstring>

namespace rebound::runner {
namespace {

class CpuPlan : public PreparedPlan {
public:
    static Result<std::unique_ptr<PreparedPlan>> create(const cpu::Device& device,
                                                        SharedBuffers<cpu::Buffer>& shared, const Plan& plan,
                                                        const PlanInputs& inputs,
                                                        const PrepareOptions& options) {
        auto program = device.compile(plan);
        if (!program) return program.error();
        auto prepared = std::unique_ptr<CpuPlan>(new CpuPlan(device, shared, *std::move(program)));
        prepared->scalar = options.precision == Precision::half ? cpu::Scalar::float16 : cpu::Scalar::float32;
        prepared->images.resize(plan.resources.size());
        prepared->buffers.resize(plan.resources.size());
        for (size_t i = 0; i < plan.resources.size(); ++i) {
            const Resource& r = plan.resources[i];
            if (r.kind == ResourceKind::output)
                prepared->images[i] = HostImage(r.extent, r.channels, prepared->scalarOf(r));
            if (r.kind == ResourceKind::outputBuffer) prepared->buffers[i].resize(r.size);
        }
        if (auto set = prepared->setInputs(inputs); !set) return set.error();
        return std::unique_ptr<PreparedPlan>(std::move(prepared));
    }

    Result<> setInputs(const PlanInputs& inputs) override {
        const Plan& plan = program.plan(); // which names are views of
        if (auto valid = checkInputs(plan, inputs); !valid) return valid;
        frame = {};
        for (size_t i = 0; i < plan.resources.size(); ++i) {
            const Resource& r = plan.resources[i];
            if (r.kind == ResourceKind::input)
                images[i] = HostImage(**findPicture(plan, inputs, r), scalarOf(r));
            if (r.kind == ResourceKind::inputBuffer) {
                auto buffer = shared.obtain(device, *findBytes(plan, inputs, r));
                if (!buffer) return buffer.error();
                frame.buffers.push_back({r.name, *std::move(buffer)});
            }
            if (r.kind == ResourceKind::outputBuffer)
                frame.buffers.push_back({r.name, {buffers[i].data(), r.size, {}}});
            if (r.kind == ResourceKind::input || r.kind == ResourceKind::output)
                frame.images.push_back({r.name, images[i].view()});
        }
        frame.constants = inputs.constants;
        return {};
    }

    Result<double> run() override {
        const auto start = std::chrono::steady_clock::now();
        if (auto recorded = program.record(frame); !recorded) return recorded.error();
        const double elapsed = millisecondsSince(start);
        auto measured = program.timings();
        if (!measured) return measured.error();
        passTimings = *std::move(measured);
        return elapsed;
    }

    const std::vector<PassTiming>& timings() const override { return passTimings; }
    MemoryUse memoryUse() const override { return program.memoryUse(); }

    Result<lab::Image> read(const std::string& output) override {
        const auto index = findOutput(program.plan(), output);
        if (!index) return index.error();
        return contents(*index);
    }

    void reset() override { program.reset(); }

    Result<Record> inspect(const Record* replacement) override {
        return inspectPasses(
            program, frame, replacement, [&](ResourceIndex r) { return contents(r); },
            [&](ResourceIndex r, const lab::Image& image) { return replace(r, image); });
    }

private:
    CpuPlan(const cpu::Device& wrapped, SharedBuffers<cpu::Buffer>& given, cpu::Program compiled)
        : device(wrapped), shared(given), program(std::move(compiled)) {}

    cpu::Scalar scalarOf(const Resource& r) const {
        if (isInteger(r.format)) return cpu::Scalar::uint32;
        return r.kind == ResourceKind::input && inputFormat(r, Precision::half) != Format::rgba16f
                   ? cpu::Scalar::float32
                   : scalar;
    }

    Result<lab::Image> contents(ResourceIndex index) const {
        const Resource& r = program.plan().resources[size_t(index)];
        if (r.kind == ResourceKind::output) return images[size_t(index)].toLabImage();
        if (r.kind == ResourceKind::outputBuffer) return rowOf(buffers[size_t(index)]);
        auto bytes = program.read(r.name);
        if (!bytes) return bytes.error();
        if (!isImage(r.kind)) return rowOf(*bytes);
        lab::Image image(r.extent, r.channels);
        std::memcpy(image.data.data(), bytes->data(), bytes->size());
        return image;
    }

    Result<> replace(ResourceIndex index, const lab::Image& image) {
        const Resource& r = program.plan().resources[size_t(index)];
        if (r.kind == ResourceKind::output) images[size_t(index)].assign(image);
        else if (r.kind == ResourceKind::outputBuffer) // which frame points into
            std::ranges::copy(bytesOf(image), buffers[size_t(index)].begin());
        else return program.write(r.name, bytesOf(image));
        return {};
    }

    const cpu::Device& device;
    SharedBuffers<cpu::Buffer>& shared;
    cpu::Program program;
    cpu::Scalar scalar = cpu::Scalar::float16;   // of all but depth
    std::vector<HostImage> images;               // by resource; empty where it is none of the host's
    std::vector<std::vector<std::byte>> buffers; // likewise; output buffers
    FrameInputs<cpu::Image> frame;
    std::vector<PassTiming> passTimings;
};

class CpuBackend : public Backend {
public:
    explicit CpuBackend(cpu::Device wrapped) : device(std::move(wrapped)) {}

    BackendInfo info() const override { return {"cpu", "", cpu::name(device.isa()), device.threads()}; }
    Result<MemoryUse> memoryUse(const Plan& plan) const override { return device.memoryUse(plan); }
    Result<std::unique_ptr<PreparedPlan>> prepare(const Plan& plan, const PlanInputs& inputs,
                                                  const PrepareOptions& options) override {
        return CpuPlan::create(device, shared, plan, inputs, options);
    }

private:
    cpu::Device device;
    SharedBuffers<cpu::Buffer> shared;
};

} // namespace

Result<std::unique_ptr<Backend>> createCpuBackend(const BackendChoice& choice) {
    cpu::DeviceOptions options;
    options.isa = choice.isa;
    options.threads = choice.threads;
    options.timings = true;
    options.moreKernels = choice.moreKernels;
    options.moreKernels.push_back(cpu::inputCheckKernels);
    auto device = cpu::Device::create(options);
    if (!device) return device.error();
    return std::unique_ptr<Backend>(std::make_unique<CpuBackend>(*std::move(device)));
}

} // namespace rebound::runner
