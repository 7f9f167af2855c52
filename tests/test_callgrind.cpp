/// What is read out of callgrind's profiles.
#include "bench/callgrind.h"
#include "host/errors.h"

#include <gtest/gtest.h>

namespace clucida::bench {
namespace {

/// A function of five instructions, which calls another twice. The lines after calls= tell what these calls cost in
/// all.
constexpr const char* profile = R"(# callgrind format
version: 1
positions: instr line
events: Ir Dr Dw D1mr D1mw Bc Bcm

ob=(1) /lib/kernel.so
fl=(1) trace.c
fn=(1) trace
0x1100 10 7
+1 * 7 7 0 2
cob=(2) /lib/libm.so
cfi=(2) exp.c
cfn=(2) exp
calls=2 0x500 3
+4 11 900 20 20
+5 12 7 0 7 0 3
-9 +1 14 0 0 0 0 14 5

ob=(2)
fl=(2)
fn=(2)
0x500 3 2
* 3 2
)";

TEST(Callgrind, adds_what_functions_cost_themselves)
{
    const ExecutedCode code = parse_callgrind(profile);
    EXPECT_EQ(code.total.instructions, 7U + 7 + 7 + 14 + 2 + 2);
    EXPECT_EQ(code.total.data_reads, 7U);
    EXPECT_EQ(code.total.data_writes, 7U);
    EXPECT_EQ(code.total.l1_data_misses, 2U + 3);
    EXPECT_EQ(code.total.conditional_branches, 14U);
    EXPECT_EQ(code.total.conditional_mispredicted, 5U);
    EXPECT_EQ(code.functions.at("trace").instructions, 35U);
    EXPECT_EQ(code.functions.at("exp").instructions, 4U);
}

TEST(Callgrind, knows_where_each_instruction_lies)
{
    const ExecutedCode code = parse_callgrind(profile);
    const std::map<std::uint64_t, std::uint64_t> kernel{{0x1100, 7}, {0x1101, 21}, {0x110a, 7}};
    EXPECT_EQ(code.files.at("/lib/libm.so").at(0x500), 4U);
    ASSERT_EQ(code.files.at("/lib/kernel.so").size(), 3U);
    EXPECT_EQ(code.files.at("/lib/kernel.so"), kernel);
}

TEST(Callgrind, refuses_profiles_without_instructions)
{
    EXPECT_THROW(parse_callgrind("positions: line\nevents: Ir\nfn=(1) f\n1 5\n"), host::Failure);
    EXPECT_THROW(parse_callgrind(""), host::Failure);
}

} // namespace
} // namespace clucida::bench
