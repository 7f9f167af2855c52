// A compiler's log under the names of the kernels' own files.
#include "host/build_log.h"

#include <gtest/gtest.h>

namespace clucida::host {
namespace {

const char* const source = "#line 1 \"kernels/a.cl\"\nint a;\n#line 7 \"kernels/b.h\"\nint b;\nnonsense;\n";

TEST(BuildLog, a_line_of_the_whole_source_gets_its_file)
{
    for (const char* name : {"<kernel>:", ":", "", "<source>:"})
        EXPECT_EQ(name_files(std::string(name) + "5:3: error: unknown type name", source),
                  "kernels/b.h:8:3: error: unknown type name\n")
            << name;
    EXPECT_EQ(name_files("<kernel>:2:5: error: e", source), "kernels/a.cl:1:5: error: e\n");
}

TEST(BuildLog, what_names_a_file_or_no_line_is_left_alone)
{
    for (const char* text : {"kernels/b.h:5:3: error: e", "<kernel>:99:1: error: beyond the end",
                             "<kernel>:1:1: error: before any file", "error: 5 of them", "    int b: 3;", ""})
        EXPECT_EQ(name_files(std::string(text) + "\n", source), std::string(text) + "\n");
}

TEST(BuildLog, the_summary_holds_the_errors_and_only_the_first_of_many)
{
    EXPECT_EQ(summarise_log("a.h:1:2: error: one\nnote\n"), "  a.h:1:2: error: one");
    std::string log;
    for (int i = 0; i < 30; ++i) log += "x: error: y\n";
    EXPECT_NE(summarise_log(log).find("and 10 more"), std::string::npos);
}

} // namespace
} // namespace clucida::host
