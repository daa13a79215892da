#include <core/spirv/folding.hpp>

namespace elvis {

namespace {

using Number = std::optional<std::uint32_t>;

std::int32_t as_signed(std::uint32_t a) { return static_cast<std::int32_t>(a); }

Number of_one(spv::Op op, std::uint32_t a) {
    switch (op) {
    case spv::OpLogicalNot:
        return a == 0 ? 1 : 0;
    case spv::OpNot:
        return ~a;
    case spv::OpSNegate:
        return 0u - a;
    case spv::OpBitcast:
        return a;
    default:
        return {};
    }
}

Number arithmetic(spv::Op op, std::uint32_t a, std::uint32_t b) {
    switch (op) {
    case spv::OpIAdd:
        return a + b;
    case spv::OpISub:
        return a - b;
    case spv::OpIMul:
        return a * b;
    case spv::OpBitwiseAnd:
    case spv::OpLogicalAnd:
        return a & b;
    case spv::OpBitwiseOr:
    case spv::OpLogicalOr:
        return a | b;
    case spv::OpBitwiseXor:
        return a ^ b;
    default:
        return {};
    }
}

Number comparison(spv::Op op, std::uint32_t a, std::uint32_t b) {
    switch (op) {
    case spv::OpIEqual:
    case spv::OpLogicalEqual:
        return a == b;
    case spv::OpINotEqual:
    case spv::OpLogicalNotEqual:
        return a != b;
    case spv::OpULessThan:
        return a < b;
    case spv::OpULessThanEqual:
        return a <= b;
    case spv::OpUGreaterThan:
        return a > b;
    case spv::OpUGreaterThanEqual:
        return a >= b;
    case spv::OpSLessThan:
        return as_signed(a) < as_signed(b);
    case spv::OpSLessThanEqual:
        return as_signed(a) <= as_signed(b);
    case spv::OpSGreaterThan:
        return as_signed(a) > as_signed(b);
    case spv::OpSGreaterThanEqual:
        return as_signed(a) >= as_signed(b);
    default:
        return {};
    }
}

/** What SPIR-V leaves undefined is left to the device. */
Number shift(spv::Op op, std::uint32_t a, std::uint32_t b) {
    if (b >= 32) {
        return {};
    }
    switch (op) {
    case spv::OpShiftLeftLogical:
        return a << b;
    case spv::OpShiftRightLogical:
        return a >> b;
    case spv::OpShiftRightArithmetic:
        return static_cast<std::uint32_t>(as_signed(a) >> b);
    default:
        return {};
    }
}

/** Likewise; of signed numbers, only where neither is negative. */
Number division(spv::Op op, std::uint32_t a, std::uint32_t b) {
    const bool is_signed = op == spv::OpSDiv || op == spv::OpSRem || op == spv::OpSMod;
    if (b == 0 || (is_signed && (as_signed(a) < 0 || as_signed(b) < 0))) {
        return {};
    }
    switch (op) {
    case spv::OpUDiv:
    case spv::OpSDiv:
        return a / b;
    case spv::OpUMod:
    case spv::OpSRem:
    case spv::OpSMod:
        return a % b;
    default:
        return {};
    }
}

Number of_two(spv::Op op, std::uint32_t a, std::uint32_t b) {
    for (const auto way : {arithmetic, comparison, shift, division}) {
        if (const Number number = way(op, a, b)) {
            return number;
        }
    }
    return {};
}

/** One of the operands, where another one decides that it is the value. */
SpirvId chosen(const SpirvInstruction& i, Number a, Number b) {
    if (i.op == spv::OpLogicalAnd || i.op == spv::OpLogicalOr) {
        const std::uint32_t deciding = i.op == spv::OpLogicalOr ? 1 : 0;
        return a ? i.words[*a == deciding ? 3 : 4] : b ? i.words[*b == deciding ? 4 : 3] : 0;
    }
    if (i.op == spv::OpSelect) {
        return a ? i.words[*a != 0 ? 4 : 5] : 0;
    }
    if (i.op == spv::OpIAdd) {
        return a == Number(0) ? i.words[4] : b == Number(0) ? i.words[3] : 0;
    }
    return 0;
}

} // namespace

SpirvId fold(const SpirvInstruction& i, SpirvValues& values) {
    const std::size_t count = i.operands.size();
    // Three words stand before the operands; literals stand behind them.
    if (i.type == 0 || count == 0 || i.words.size() != 3 + count) {
        return 0;
    }
    const Number a = values.number(i.words[3]), b = count > 1 ? values.number(i.words[4]) : std::nullopt;
    const SpirvId operand = chosen(i, a, b);
    if (operand != 0 && values.type_of(operand) == i.type) {
        return operand;
    }
    if (!values.is_bool(i.type) && !values.is_int(i.type)) {
        return 0;
    }
    const Number number = a && count == 1 ? of_one(i.op, *a) : a && b && count == 2 ? of_two(i.op, *a, *b) : std::nullopt;
    return number ? values.constant(i.type, *number) : 0;
}

} // namespace elvis
