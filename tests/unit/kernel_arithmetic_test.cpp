// SPDX-License-Identifier: MIT
// Arithmetic of the kernel language, in every instruction set, against the host's.
#include "arithmetic_operands.hpp"

#include <cmath>
#include <functional>
#include <limits>

namespace rebound::test {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Picture arithmetic(cpu::Isa isa, int operation, Operands& o) {
    return runKernel(isa, arithmetic(operation, o));
}

std::vector<float> hardValues() {
    return {0.0f,     -0.0f,    1.0f,    -1.0f,    0.5f,      1.5f,          -2.5f,      3e38f,      -3e38f,
            1.2e-38f, 1e-40f,   -1e-45f, infinity, -infinity, nan,           8388608.0f, 8388607.5f, 1e10f,
            -0.25f,   65504.0f, 0.1f,    -7.75f,   99.999f,   2147483600.0f, -4194304.5f};
}

Operands withoutMinusZero(Operands o) {
    for (float& x : o.x.values)
        if (x == 0.0f) x = 0.0f;
    return o;
}

using Function = std::function<float(float, float, float)>;

// Equal to the bit; any NaN equals any other.
void checkExactly(int operation, const Operands& operands, const Function& expected) {
    Operands o = operands;
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture result = arithmetic(isa, operation, o);
        int wrong = 0;
        for (size_t i = 0; i < o.x.values.size(); ++i) {
            const float want = expected(o.x.values[i], o.y.values[i], o.z.values[i]),
                        got = result.values[4 * i];
            const bool same =
                std::isnan(want) ? std::isnan(got) : got == want && std::signbit(got) == std::signbit(want);
            if (!same && ++wrong == 1)
                FAIL_CHECK("operation " << operation << " in " << std::string(cpu::name(isa)) << " of "
                                        << o.x.values[i] << ", " << o.y.values[i] << ", " << o.z.values[i]
                                        << " is " << got << ", not " << want);
        }
        CHECK(wrong == 0);
    }
}

float truth(bool b) { return b ? 1.0f : 0.0f; }

} // namespace

TEST_CASE("Real: the operators of arithmetic") {
    const Operands o = everyPair(hardValues());
    for (int op : {opAdd, opAddTo}) checkExactly(op, o, [](float x, float y, float) { return x + y; });
    for (int op : {opSubtract, opSubtractFrom})
        checkExactly(op, o, [](float x, float y, float) { return x - y; });
    for (int op : {opMultiply, opMultiplyBy})
        checkExactly(op, o, [](float x, float y, float) { return x * y; });
    for (int op : {opDivide, opDivideBy}) checkExactly(op, o, [](float x, float y, float) { return x / y; });
    checkExactly(opNegate, o, [](float x, float, float) { return -x; });
}

TEST_CASE("Real: comparisons and masks, false where NaN is compared") {
    const Operands o = everyPair(hardValues());
    checkExactly(opLess, o, [](float x, float y, float) { return truth(x < y); });
    checkExactly(opGreater, o, [](float x, float y, float) { return truth(x > y); });
    checkExactly(opLessEqual, o, [](float x, float y, float) { return truth(x <= y); });
    checkExactly(opGreaterEqual, o, [](float x, float y, float) { return truth(x >= y); });
    checkExactly(opEqual, o, [](float x, float y, float) { return truth(x == y); });
    checkExactly(opAnd, o, [](float x, float y, float z) { return truth(x < y && x < z); });
    checkExactly(opOr, o, [](float x, float y, float z) { return truth(x < y || x < z); });
    checkExactly(opNot, o, [](float x, float y, float) { return truth(!(x < y)); });
    checkExactly(opSelect, o, [](float x, float y, float z) { return z > 0.0f ? x : y; });
}

TEST_CASE("Real: functions that are exact or rounded once") {
    const Operands o = everyPair(hardValues());
    // The first operand where one of the two is NaN, and where they are equal.
    checkExactly(opMin, o, [](float x, float y, float) { return y < x ? y : x; });
    checkExactly(opMax, o, [](float x, float y, float) { return x < y ? y : x; });
    checkExactly(opAbs, o, [](float x, float, float) { return std::fabs(x); });
    checkExactly(opSqrt, o, [](float x, float, float) { return std::sqrt(x); });
    // Plus zero: the sign of a zero that is rounded is left open.
    checkExactly(opFloor, withoutMinusZero(o), [](float x, float, float) { return std::floor(x); });
    checkExactly(opIsFinite, o, [](float x, float, float) { return truth(std::isfinite(x)); });
    checkExactly(opClamp, o, [](float x, float, float) {
        return std::isnan(x) ? x : std::fmin(std::fmax(x, -2.0f), 100.0f);
    });
}

TEST_CASE("Int: every operator") {
    const Operands o = everyPair(wholeNumbers());
    auto integer = [](auto f) {
        return Function([f](float x, float y, float) { return float(f(int(x), int(y))); });
    };
    checkExactly(opIntAdd, o, integer([](int x, int y) { return x + y; }));
    checkExactly(opIntSubtract, o, integer([](int x, int y) { return x - y; }));
    checkExactly(opIntMultiply, o, integer([](int x, int y) { return x * y; }));
    checkExactly(opIntAnd, o, integer([](int x, int y) { return x & y; }));
    checkExactly(opIntOr, o, integer([](int x, int y) { return x | y; }));
    checkExactly(opIntShiftRight, o, integer([](int x, int) { return x >> 3; }));
    checkExactly(opIntShiftLeft, o, integer([](int x, int) { return x * 8; }));
    checkExactly(opIntEqual, o, integer([](int x, int y) { return x == y ? 1 : 0; }));
    checkExactly(opIntLess, o, integer([](int x, int y) { return x < y ? 1 : 0; }));
    checkExactly(opIntGreater, o, integer([](int x, int y) { return x > y ? 1 : 0; }));
    checkExactly(opRoundTrip, o, integer([](int x, int) { return x; }));
    checkExactly(opIntSelect, o, [](float x, float y, float z) { return float(z > 0.0f ? int(x) : int(y)); });
}

TEST_CASE("inverseSqrt and reciprocal: within a relative 5e-7 of the truth, a rough one within 4e-4") {
    // The processor's estimate is off by 1.5 * 2^-12 = 3.7e-4 at most; a step of Newton's method leaves 1.5
    // and 1 times its square, 2.0e-7, and each of up to 4 roundings adds 6e-8.
    const double bound = 5e-7, roughBound = 4e-4;
    Operands o{Picture({1000, 4}, 1), Picture({1000, 4}, 1), Picture({1000, 4}, 1)};
    for (size_t i = 0; i < o.x.values.size(); ++i)
        o.x.values[i] = std::ldexp(1.0f + float(i % 997) / 997.0f, int(i * 13 % 240) - 120);
    for (cpu::Isa isa : cpu::availableIsas())
        for (int operation : {opInverseSqrt, opReciprocal, opRoughReciprocal}) {
            const Picture result = arithmetic(isa, operation, o);
            double worst = 0.0;
            for (size_t i = 0; i < o.x.values.size(); ++i) {
                const double x = o.x.values[i],
                             want = operation == opInverseSqrt ? 1.0 / std::sqrt(x) : 1.0 / x;
                worst = std::max(worst, std::abs(double(result.values[4 * i]) / want - 1.0));
            }
            INFO(std::string(cpu::name(isa)));
            CHECK(worst < (operation == opRoughReciprocal ? roughBound : bound));
        }
}

TEST_CASE("mix: from the first to the second operand") {
    Operands o = everyPair({0.0f, 1.0f, 0.5f, 0.25f, -3.0f, 8.0f});
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture result = arithmetic(isa, opMix, o);
        // These operands' products and sums are exact: so is the result, with or without fused operations.
        for (size_t i = 0; i < o.x.values.size(); ++i)
            CHECK(result.values[4 * i] == o.x.values[i] + (o.y.values[i] - o.x.values[i]) * o.z.values[i]);
    }
}

TEST_CASE("vectors: GLSL's functions") {
    Operands o = exactVectors();
    for (cpu::Isa isa : cpu::availableIsas()) {
        const Picture result = arithmetic(isa, opVectors, o);
        const Picture selected = arithmetic(isa, opVectorSelect, o);
        for (size_t i = 0; i < o.x.values.size() / 4; ++i) {
            const float *a = &o.x.values[4 * i], *b = &o.y.values[4 * i], *c = &o.z.values[4 * i];
            const glm::vec3 u(a[0], a[1], a[2]), v(b[0], b[1], b[2]);
            const glm::vec3 w =
                glm::cross(u, v) + glm::min(u, v) * 2.0f + glm::max(u, 0.25f) + glm::vec3(1, 2, 3);
            // Operands are small multiples of 1/32: all but the root is exact.
            for (int k = 0; k < 3; ++k) CHECK(result.values[4 * i + size_t(k)] == w[k]);
            const float dots = glm::dot(u, v) + a[0] * b[0] + a[1] * b[1];
            CHECK(result.values[4 * i + 3] == doctest::Approx(dots + glm::length(u)).epsilon(1e-6));
            const float want[4] = {c[0] > 0 ? a[1] : b[1], c[1] > 0 ? a[3] : b[3], c[1] > 0 ? a[0] : b[0],
                                   c[2] > 0 ? a[3] : b[3]};
            for (size_t k = 0; k < 4; ++k) CHECK(selected.values[4 * i + k] == want[k]);
        }
    }
}

} // namespace rebound::test
