// SPDX-License-Identifier: MIT
#include "lab/runner/host_image.hpp"
#include "lab/runner/inspection.hpp"
#include "rebound/techniques/input_check.hpp"

namespace rebound::runner {
namespace {

class CpuPlan : public PreparedPlan {
public:
    static Result<std::unique_ptr<PreparedPlan>> create(const cpu::Device& device, const Plan& plan,
                                                        const PlanInputs& inputs,
                                                        const PrepareOptions& options) {
        auto program = device.compile(plan);
        if (!program) return program.error();
        auto prepared = std::unique_ptr<CpuPlan>(new CpuPlan(*std::move(program)));
        prepared->scalar = options.precision == Precision::half ? cpu::Scalar::float16 : cpu::Scalar::float32;
        prepared->images.resize(plan.resources.size());
        for (size_t i = 0; i < plan.resources.size(); ++i)
            if (const Resource& r = plan.resources[i]; r.kind == ResourceKind::output)
                prepared->images[i] = HostImage(r.extent, r.channels, prepared->scalar);
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
                images[i] = HostImage(**findPicture(plan, inputs, r),
                                      r.format == Format::r32f ? cpu::Scalar::float32 : scalar);
            if (r.kind == ResourceKind::input || r.kind == ResourceKind::output)
                frame.images.push_back({r.name, images[i].view()});
        }
        frame.constants = inputs.constants;
        return {};
    }

    Result<double> run() override {
        const auto start = std::chrono::steady_clock::now();
        if (auto recorded = program.record(frame); !recorded) return recorded.error();
        return millisecondsSince(start);
    }

    const std::vector<PassTiming>& timings() const override { return program.timings(); }
    MemoryUse memoryUse() const override { return program.memoryUse(); }

    Result<lab::Image> read(const std::string& output) override {
        const auto index = findOutput(program.plan(), output);
        if (!index) return index.error();
        return images[size_t(*index)].toLabImage();
    }

    Result<Record> inspect(const Record* replacement) override {
        return inspectPasses(
            program, frame, replacement, [&](ResourceIndex r) { return contents(r); },
            [&](ResourceIndex r, const lab::Image& image) { return replace(r, image); });
    }

private:
    explicit CpuPlan(cpu::Program compiled) : program(std::move(compiled)) {}

    Result<lab::Image> contents(ResourceIndex index) const {
        const Resource& r = program.plan().resources[size_t(index)];
        if (r.kind == ResourceKind::output) return images[size_t(index)].toLabImage();
        auto texels = program.readTransient(r.name);
        if (!texels) return texels.error();
        lab::Image image(r.extent, r.channels);
        image.data = *std::move(texels);
        return image;
    }

    Result<> replace(ResourceIndex index, const lab::Image& image) {
        const Resource& r = program.plan().resources[size_t(index)];
        if (r.kind != ResourceKind::output) return program.writeTransient(r.name, image.data);
        images[size_t(index)].assign(image);
        return {};
    }

    cpu::Program program;
    cpu::Scalar scalar = cpu::Scalar::float16; // of all but depth
    std::vector<HostImage> images;             // by resource; empty where it is none of the host's
    FrameInputs<cpu::Image> frame;
};

class CpuBackend : public Backend {
public:
    explicit CpuBackend(cpu::Device wrapped) : device(std::move(wrapped)) {}

    BackendInfo info() const override { return {"cpu", "", cpu::name(device.isa()), device.threads()}; }
    Result<MemoryUse> memoryUse(const Plan& plan) const override { return device.memoryUse(plan); }
    Result<std::unique_ptr<PreparedPlan>> prepare(const Plan& plan, const PlanInputs& inputs,
                                                  const PrepareOptions& options) override {
        return CpuPlan::create(device, plan, inputs, options);
    }

private:
    cpu::Device device;
};

} // namespace

Result<std::unique_ptr<Backend>> createCpuBackend(const BackendChoice& choice) {
    cpu::DeviceOptions options;
    options.isa = choice.isa;
    options.threads = choice.threads;
    options.timings = true;
    options.moreKernels = {cpu::inputCheckKernels};
    auto device = cpu::Device::create(options);
    if (!device) return device.error();
    return std::unique_ptr<Backend>(std::make_unique<CpuBackend>(*std::move(device)));
}

} // namespace rebound::runner
