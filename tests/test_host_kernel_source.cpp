#include "host/kernel_source.h"

#include <gtest/gtest.h>

#include <map>

namespace clucida::host {
namespace {

std::string resolve(const std::map<std::string, std::string>& files, const std::string& entry)
{
    return resolve_includes(entry, [&](const std::string& path) -> std::optional<std::string_view> {
        const auto found = files.find(path);
        if (found == files.end()) return std::nullopt;
        return found->second;
    });
}

TEST(KernelSource, an_include_is_replaced_by_its_file_and_line_numbers_go_on_after_it)
{
    EXPECT_EQ(
        resolve({{"kernels/a.cl", "one\n#include \"kernels/b.h\"\nthree\n"}, {"kernels/b.h", "b\n"}}, "kernels/a.cl"),
        "#line 1 \"kernels/a.cl\"\none\n#line 1 \"kernels/b.h\"\nb\n#line 3 \"kernels/a.cl\"\nthree\n");
}

TEST(KernelSource, a_file_is_included_once)
{
    const std::string text =
        resolve({{"k/a", "#include \"k/b\"\n#include \"k/b\"\n"}, {"k/b", "#include \"k/a\"\nB\n"}}, "k/a");
    EXPECT_EQ(text.find("B\n"), text.rfind("B\n"));
}

TEST(KernelSource, an_include_may_be_relative_to_the_file_it_stands_in)
{
    const std::string text =
        resolve({{"kernels/solids/s.h", "#include \"../vec.h\"\n"}, {"kernels/vec.h", "VEC\n"}}, "kernels/solids/s.h");
    EXPECT_NE(text.find("VEC\n"), std::string::npos);
}

TEST(KernelSource, what_is_no_known_file_or_stands_in_angle_brackets_is_left_alone)
{
    EXPECT_EQ(resolve({{"a", "#include <math.h>\n#include \"none.h\"\n"}}, "a"),
              "#line 1 \"a\"\n#include <math.h>\n#include \"none.h\"\n");
}

TEST(KernelSource, a_block_that_opencl_skips_is_left_alone)
{
    const std::map<std::string, std::string> files = {{"shim", "SHIM\n"}, {"b", "B\n"}};
    for (const std::string block : {"#ifndef __OPENCL_VERSION__\n#if X\n#include \"shim\"\n#endif\n#endif\n",
                                    "#ifdef __OPENCL_VERSION__\n#else /* host */\n# include \"shim\"\n#endif\n"}) {
        auto with = files;
        with["a"] = block + "#include \"b\"\n";
        const std::string text = resolve(with, "a");
        EXPECT_EQ(text.find("SHIM"), std::string::npos) << text;
        EXPECT_NE(text.find("B\n"), std::string::npos) << text;
    }
}

TEST(KernelSource, a_file_first_named_in_a_skipped_block_is_still_included_where_it_counts)
{
    const std::string text =
        resolve({{"a", "#ifndef __OPENCL_VERSION__\n#include \"b\"\n#endif\n#include \"b\"\n"}, {"b", "B\n"}}, "a");
    EXPECT_NE(text.find("B\n"), std::string::npos);
}

TEST(KernelSource, an_unknown_entry_is_an_error)
{
    EXPECT_THROW(resolve({}, "a"), std::runtime_error);
}

TEST(KernelSource, the_embedded_kernels_hold_the_entry_points_and_all_they_include)
{
    for (const char* entry : {"kernels/render.cl", "kernels/selftest.cl"}) {
        const std::string text = kernel_source(entry);
        EXPECT_NE(text.find("__kernel"), std::string::npos) << entry;
        EXPECT_NE(text.find("#line 1 \"kernels/real.h\""), std::string::npos) << entry;
    }
}

} // namespace
} // namespace clucida::host
