/// The classifier of machine code, on instructions as disassemblers print them.
#include "bench/disassembly.h"
#include "bench/instruction_mix.h"

#include <gtest/gtest.h>

namespace clucida::bench {
namespace {

TEST(InstructionMix, tells_packed_from_scalar_and_float_from_double)
{
    const Instruction packed = classify("vaddps %ymm3,%ymm2,%ymm1");
    EXPECT_EQ(packed.operation, Operation::arithmetic);
    EXPECT_EQ(packed.element, Element::single);
    EXPECT_TRUE(packed.packed);
    EXPECT_EQ(packed.width, 256U);
    const Instruction scalar = classify("vmulsd %xmm3,%xmm2,%xmm1");
    EXPECT_EQ(scalar.element, Element::twofold);
    EXPECT_FALSE(scalar.packed);
    EXPECT_EQ(describe({scalar.operation, scalar.element, scalar.packed, 0}), "add, subtract, multiply scalar double");
}

TEST(InstructionMix, knows_what_instructions_do)
{
    const std::pair<const char*, Operation> expected[] = {
        {"vfmadd213ps (%rax),%ymm1,%ymm2", Operation::fma},
        {"vfnmsub231sd %xmm0,%xmm1,%xmm2", Operation::fma},
        {"vdivps %ymm1,%ymm2,%ymm3", Operation::divide},
        {"divss %xmm1,%xmm2", Operation::divide},
        {"vrcp14ps %zmm1,%zmm2", Operation::divide},
        {"vsqrtss %xmm1,%xmm2,%xmm3", Operation::square_root},
        {"vminps %ymm1,%ymm2,%ymm3", Operation::min_max},
        {"vcmpltps %ymm1,%ymm2,%k1", Operation::compare_blend},
        {"vucomiss 0x10(%rsp),%xmm1", Operation::compare_blend},
        {"vblendvps %ymm0,%ymm1,%ymm2,%ymm3", Operation::compare_blend},
        {"vandps %ymm0,%ymm1,%ymm2", Operation::logic},
        {"vcvtdq2ps %ymm0,%ymm1", Operation::convert},
        {"vcvttss2si %xmm0,%eax", Operation::convert},
        {"vroundps $0x9,%ymm0,%ymm1", Operation::convert},
        {"vpermilps $0xee,%ymm0,%ymm1", Operation::shuffle},
        {"vextractf128 $0x1,%ymm0,%xmm1", Operation::shuffle},
        {"vbroadcastss 0x4(%rdi),%ymm1", Operation::shuffle},
        {"vmovups %ymm0,0x40(%rsp)", Operation::move},
        {"vmovdqa64 %zmm0,%zmm1", Operation::move},
        {"vgatherdps (%rax,%ymm1,4),%ymm2{%k1}", Operation::gather},
        {"vpgatherdd %ymm0,(%rax,%ymm1,4),%ymm2", Operation::gather},
        {"vpaddd %ymm0,%ymm1,%ymm2", Operation::vector_integer},
        {"vmovmskps %ymm0,%eax", Operation::mask},
        {"kmovd %k0,%eax", Operation::mask},
        {"kortestb %k0,%k1", Operation::mask},
        {"lea 0x8(%rax,%rcx,4),%rdx", Operation::integer},
        {"push %rbp", Operation::integer},
        {"popcnt %eax,%ecx", Operation::integer},
        {"jne 1f40 <f+0x20>", Operation::branch},
        {"jmp *0x8(%rax)", Operation::branch},
        {"call 1000 <memset@plt>", Operation::call},
        {"ret", Operation::call},
        {"nopw 0x0(%rax,%rax,1)", Operation::other},
        {"vzeroupper", Operation::other},
    };
    for (const auto& [text, operation] : expected) EXPECT_EQ(classify(text).operation, operation) << text;
}

struct Access {
    const char* text;
    unsigned load_bits, store_bits;
};

TEST(InstructionMix, tells_loads_from_stores_and_how_wide_they_are)
{
    const Access expected[] = {
        {"vmovups 0x40(%rsp),%ymm0", 256, 0},
        {"vmovups %zmm0,0x40(%rsp)", 0, 512},
        {"vaddss 0x4(%rdi),%xmm1,%xmm2", 32, 0},
        {"vmulpd 0x10(%rdi),%xmm1,%xmm2", 128, 0},
        {"vmulps 0x10(%rdi){1to8},%ymm1,%ymm2", 32, 0},
        {"vbroadcastss 0x4(%rdi),%ymm1", 32, 0},
        {"vmovd %xmm0,0x8(%rsp)", 0, 32},
        {"vmovsd 0x8(%rsp),%xmm0", 64, 0},
        {"vinsertf128 $0x1,(%rax),%ymm0,%ymm1", 128, 0},
        {"vextractf128 $0x1,%ymm0,(%rax)", 0, 128},
        {"vcvtsi2ssl 0x8(%rdi),%xmm0,%xmm1", 32, 0},
        {"mov 0x8(%rax),%ecx", 32, 0},
        {"mov %r8,0x8(%rsp)", 0, 64},
        {"mov %r9d,0x8(%rsp)", 0, 32},
        {"movl $0x0,0x8(%rsp)", 0, 32},
        {"movzbl (%rax),%ecx", 8, 0},
        {"add %eax,0x10(%rdi)", 32, 32},
        {"incl 0x10(%rdi)", 32, 32},
        {"lock xadd %eax,(%rdi)", 32, 32},
        {"cmp %eax,0x10(%rdi)", 32, 0},
        {"cmpl $0x1,0x10(%rdi)", 32, 0},
        {"sete 0x7(%rsp)", 0, 8},
        {"lea 0x8(%rax),%rcx", 0, 0},
        {"vaddps %ymm1,%ymm2,%ymm3", 0, 0},
        {"mov %fs:0x28,%rax", 64, 0},
        {"call *0x8(%rax)", 64, 0},
    };
    for (const Access& e : expected) {
        const Instruction i = classify(e.text);
        EXPECT_EQ(i.load_bits, e.load_bits) << e.text;
        EXPECT_EQ(i.store_bits, e.store_bits) << e.text;
    }
}

TEST(InstructionMix, counts_floating_point_operations_by_lanes)
{
    EXPECT_EQ(flops(classify("vaddps %ymm1,%ymm2,%ymm3")), 8U);
    EXPECT_EQ(flops(classify("vfmadd213pd %ymm1,%ymm2,%ymm3")), 8U);
    EXPECT_EQ(flops(classify("vfmadd213ps %zmm1,%zmm2,%zmm3")), 32U);
    EXPECT_EQ(flops(classify("vsqrtss %xmm1,%xmm2,%xmm3")), 1U);
    EXPECT_EQ(flops(classify("vminps %ymm1,%ymm2,%ymm3")), 0U);
    EXPECT_EQ(flops(classify("vpaddd %ymm1,%ymm2,%ymm3")), 0U);
}

constexpr const char* gnu_text = R"(
kernel.so:     file format elf64-x86-64


Disassembly of section .text:

0000000000001100 <trace>:
    1100:	push   %rbp
    1101:	vaddps (%rdi),%ymm1,%ymm2
    1105:	vfmadd231ps %ymm1,%ymm2,%ymm3
    110a:	jne    1101 <trace+0x1>
    110c:	ret

0000000000001110 <walk>:
    1110:	vmovss 0x10(%rip),%xmm0        # 2000 <table>
    1118:	ret
)";

constexpr const char* llvm_text = R"(
kernel.so:	file format elf64-x86-64

Disassembly of section .text:

0000000000001100 <trace>:
    1100:      	pushq	%rbp
    1101:      	vaddps	(%rdi), %ymm1, %ymm2
    1105:      	vfmadd231ps	%ymm1, %ymm2, %ymm3     # ymm3 = (ymm2 * ymm1) + ymm3
    110a:      	jne	0x1101 <trace+0x1>
    110c:      	retq

0000000000001110 <walk>:
    1110:      	vmovss	16(%rip), %xmm0         # xmm0 = mem[0],zero,zero,zero
    1118:      	retq
)";

TEST(Disassembly, is_read_as_either_program_prints_it)
{
    for (const char* text : {gnu_text, llvm_text}) {
        const std::vector<CodeFunction> functions = parse_disassembly(text);
        ASSERT_EQ(functions.size(), 2U);
        EXPECT_EQ(functions[0].name, "trace");
        EXPECT_EQ(functions[1].name, "walk");
        ASSERT_EQ(functions[0].code.size(), 5U);
        EXPECT_EQ(functions[0].code[1].address, 0x1101U);
        const InstructionMix mix = mix_of(functions[0]);
        EXPECT_EQ(mix.instructions, 5U);
        EXPECT_EQ(mix.single_flops, 24U);
        EXPECT_EQ(mix.load_bytes, 32U);
        EXPECT_EQ(count(mix, Operation::branch), 1U);
        EXPECT_EQ(mix_of(functions[1]).loads.at(32), 1U);
    }
}

TEST(InstructionMix, of_parts_adds_up)
{
    InstructionMix sum;
    for (const CodeFunction& f : parse_disassembly(gnu_text)) add(sum, mix_of(f));
    std::uint64_t kinds = 0;
    for (const auto& [kind, times] : sum.kinds) kinds += times;
    EXPECT_EQ(sum.instructions, 7U);
    EXPECT_EQ(kinds, 7U);
    EXPECT_EQ(sum.kinds.at({Operation::call, Element::none, false, 0}), 2U);
}

} // namespace
} // namespace clucida::bench
