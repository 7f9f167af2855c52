/// What the tests of readers share: reading a text beside the test scenes, and errors whose place is marked in it.
#pragma once

#include "scene/read.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <sstream>
#include <string>

namespace clucida::scene::test {

inline std::filesystem::path data_folder()
{
    return std::filesystem::path(CLUCIDA_TEST_DATA) / "scenes";
}

inline std::string data_text(const std::string& name)
{
    std::ifstream file(data_folder() / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_FALSE(text.str().empty()) << name;
    return text.str();
}

inline Scene read(const std::string& text, Format format = Format::clucida)
{
    return read_scene(text, "scene", format, data_folder());
}

/// The error of reading text, or nothing if it reads.
inline std::optional<Error> error_of(const std::string& text, Format format = Format::clucida)
{
    try {
        read(text, format);
    } catch (const Error& error) {
        return error;
    }
    return std::nullopt;
}

/// Expects an error at the place that '@' marks in the text, with a message that has part in it.
inline void expect_error(std::string text, const std::string& part, Format format = Format::clucida)
{
    SCOPED_TRACE(text);
    const std::size_t mark = text.find('@');
    ASSERT_NE(mark, std::string::npos);
    text.erase(mark, 1);
    const std::string before = text.substr(0, mark);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t column = mark - (before.rfind('\n') + 1) + 1;
    const std::optional<Error> error = error_of(text, format);
    ASSERT_TRUE(error.has_value()) << "it reads";
    const std::string place = "scene:" + std::to_string(line) + ":" + std::to_string(column) + ": error: ";
    const std::string what = error->what();
    EXPECT_EQ(what.substr(0, place.size()), place) << what;
    EXPECT_NE(what.substr(0, what.find('\n')).find(part), std::string::npos) << what;
}

} // namespace clucida::scene::test
