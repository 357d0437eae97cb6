#include "host/selftest/selftest.hpp"

#include "selftest/rules.h"

#include <array>

#include <fmt/format.h>

namespace macula::selftest {
namespace {

constexpr std::uint32_t kInputs = 1u << 16;

constexpr std::array<const char*, MACULA_RULES> kRules = {
    "no contraction of a * b + c",
    "fma",
    "fma of a cancelling product",
    "division",
    "square root",
    "rint and floor",
    "conversion to int",
    "exp2",
    "log2",
    "pow",
    "sine",
    "cosine",
    "acos and atan2",
    "difference of products",
};

// Deterministic triples (a, b, c) in the ranges that selftest/rules.h states.
std::vector<float> make_inputs() {
    std::vector<float> inputs;
    inputs.reserve(3 * kInputs);
    std::uint32_t state = 12345;
    const auto unit = [&state] { // [1, 2)
        state = state * 1664525u + 1013904223u;
        return shared::as_float(0x3f800000u | (state >> 9));
    };
    for (std::uint32_t i = 0; i < kInputs; ++i) {
        inputs.push_back((unit() - 1.5f) * 8.0f);
        inputs.push_back(unit());
        inputs.push_back((unit() - 1.5f) * 2000.0f);
    }
    return inputs;
}

std::string facts_of(const compute::Device& device, kernel::Library& library) {
    compute::Buffer out = device.allocate_array<std::uint32_t>(2, "arithmetic facts");
    library.kernel(kernel::VariantKey("selftest/arithmetic"), "facts", device)
        .set(0x1p-126f, 0.0f, out)
        .launch("arithmetic facts", {1});
    return out.read_one<std::uint32_t>() == 0 ? "denormals are flushed" : "denormals are kept";
}

} // namespace

Outcome check_arithmetic(const compute::Device& device, kernel::Library& library) {
    const std::vector<float> inputs = make_inputs();
    compute::Buffer in = device.upload(std::span(inputs), "arithmetic inputs");
    compute::Buffer out = device.allocate_array<std::uint32_t>(
        std::uint64_t{kInputs} * MACULA_RULES, "arithmetic results");
    library.kernel(kernel::VariantKey("selftest/arithmetic"), "arithmetic", device)
        .set(in, out, kInputs)
        .launch("portable arithmetic", {kInputs});
    const auto found = out.map_read<std::uint32_t>();
    for (std::uint32_t i = 0; i < kInputs; ++i) {
        std::array<shared::uint, MACULA_RULES> expected{};
        const float* in_i = &inputs[3 * i];
        shared::evaluate_rules(in_i[0], in_i[1], in_i[2], expected.data());
        for (std::uint32_t rule = 0; rule < MACULA_RULES; ++rule) {
            const std::uint32_t word = found[i * MACULA_RULES + rule];
            if (word != expected[rule]) {
                return {"portable arithmetic", false,
                        fmt::format("rule '{}' broken: for ({:a}, {:a}, {:a}) the device gives "
                                    "{:08x}, the host {:08x}",
                                    kRules[rule], in_i[0], in_i[1], in_i[2], word, expected[rule])};
            }
        }
    }
    return {
        "portable arithmetic", true,
        fmt::format("{} rules x {} inputs; {}", MACULA_RULES, kInputs, facts_of(device, library))};
}

} // namespace macula::selftest
