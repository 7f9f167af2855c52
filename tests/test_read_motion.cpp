// Scenes in time: sequences, t and frame, parameters, and numbers that look random.
#include "scene/write.h"
#include "test_read_support.h"

#include <cmath>
#include <map>

namespace clucida::scene::test {
namespace {

const std::string begin = "clucida 1\n";
const std::string end = "\nobserver { eye [0, 0, 0]; look [0, 1, 0] }\n";

/// The scene's one light, in which the tests put what they compute.
Scene at(const std::string& text, const Moment& moment, Usage* usage = nullptr)
{
    ReadOptions options;
    options.moment = moment;
    return read_scene(begin + text + end, "scene", Format::clucida, data_folder(), options, usage);
}

Vec3 point(const std::string& sequence, const std::string& vector, const Moment& moment)
{
    return at(sequence + "\nlight { point " + vector + " }", moment).lights.at(0).point;
}

double number(const std::string& expression, const Moment& moment = {1, 10, {}})
{
    return point("", "[" + expression + ", 0, 0]", moment).x;
}

std::string message(const std::string& text, const Moment& moment)
{
    try {
        at(text, moment);
    } catch (const Error& e) {
        return e.what();
    }
    return "";
}

TEST(Motion, TimeGoesFromTheFirstFrameToTheLast)
{
    const std::string sequence = "sequence { frames 5; fps 12.5 }";
    EXPECT_EQ(point(sequence, "[t, frame, frames]", {1, 0, {}}), (Vec3{0, 1, 5}));
    EXPECT_EQ(point(sequence, "[t, frame, frames]", {3, 0, {}}), (Vec3{0.5, 3, 5}));
    EXPECT_EQ(point(sequence, "[t, frame, frames]", {5, 0, {}}), (Vec3{1, 5, 5}));
    EXPECT_EQ(at(sequence, {}).sequence, (Sequence{5, 12.5, false}));
}

TEST(Motion, OfALoopTheFirstFrameFollowsTheLast)
{
    EXPECT_EQ(point("sequence { frames 4; loop }", "[t, 0, 0]", {4, 0, {}}).x, 0.75);
    EXPECT_EQ(point("sequence { frames 1 }", "[t, 0, 0]", {1, 0, {}}).x, 0);
}

TEST(Motion, TheMomentMayHaveAnotherNumberOfFrames)
{
    EXPECT_EQ(point("sequence { frames 5 }", "[t, frames, 0]", {3, 3, {}}), (Vec3{1, 3, 0}));
    EXPECT_EQ(number("t", {2, 3, {}}), 0.5);
}

TEST(Motion, TimeNeedsANumberOfFrames)
{
    EXPECT_NE(message("light { point [t, 0, 0] }", {}).find("sequence { frames N }"), std::string::npos);
    EXPECT_NE(message("light { point [t, 0, 0] }\nsequence { frames 3 }", {}).find("scene:2:16"), std::string::npos);
    EXPECT_EQ(message("light { point [frame, 0, 0] }", {}), "");
}

TEST(Motion, ItIsKnownWhetherFramesDiffer)
{
    for (const auto& [text, moves] : std::map<std::string, bool>{{"let a = 2*pi", false},
                                                                 {"let a = 2*t", true},
                                                                 {"let a = frame", true},
                                                                 {"let a = frames", false},
                                                                 {"parameter p = 3\nlet a = p", false}}) {
        Usage usage;
        at("sequence { frames 9 }\n" + text, {}, &usage);
        EXPECT_EQ(usage.time, moves) << text;
    }
}

TEST(Motion, SenselessSequencesSayWhere)
{
    for (const char* text : {"sequence { frames 0 }", "sequence { frames 1.5 }", "sequence { frames 1000001 }",
                             "sequence { fps 0 }", "sequence { fps -1 }", "sequence { fps 1001 }",
                             "sequence { }\nsequence { }", "let t = 1", "let frame = 1", "let frames = 2"})
        EXPECT_NE(message(text, {}).find("scene:"), std::string::npos) << text;
}

TEST(Motion, ParametersHaveOtherValuesFromOutside)
{
    const std::string text = "parameter r = 2\nparameter v = [1, 2, 3]\nlet a = r + 1\nlight { point v }\n"
                             "light { point [a, 0, 0] }";
    const Scene own = at(text, {});
    EXPECT_EQ(own.lights[0].point, (Vec3{1, 2, 3}));
    EXPECT_EQ(own.lights[1].point.x, 3);
    const Scene other = at(text, {1, 0, {{"r", "2*pi"}, {"v", "[4, 5, sqrt(9)]"}}});
    EXPECT_EQ(other.lights[0].point, (Vec3{4, 5, 3}));
    EXPECT_DOUBLE_EQ(other.lights[1].point.x, 2 * M_PI + 1);
}

TEST(Motion, WrongParametersAreRefused)
{
    const std::string text = "parameter radius = 2";
    for (const auto& [name, value, expected] :
         std::vector<std::array<std::string, 3>>{{"raduis", "1", "did you mean 'radius'"},
                                                 {"radius", "[1, 2, 3]", "expected a number"},
                                                 {"radius", "", "expected a number"},
                                                 {"radius", "1 2", "--set radius"},
                                                 {"radius", "nonsense", "unknown name"},
                                                 {"radius", "1/0", "--set radius"}}) {
        const std::string what = message(text, {1, 0, {{name, value}}});
        EXPECT_NE(what.find(expected), std::string::npos) << name << "=" << value << ": " << what;
    }
}

TEST(Motion, AnErrorNamesItsFrame)
{
    const std::string text = "sequence { frames 10 }\nlight { point [1/(frame - 4), sqrt(8 - frame), 0] }";
    EXPECT_EQ(message(text, {3, 10, {}}), "");
    EXPECT_NE(message(text, {4, 10, {}}).find("(in frame 4)"), std::string::npos);
    EXPECT_NE(message(text, {9, 10, {}}).find("scene:3:31"), std::string::npos) << message(text, {9, 10, {}});
    EXPECT_NE(message(text, {9, 10, {}}).find("(in frame 9)"), std::string::npos);
}

TEST(Motion, FunctionsDoAsTheyAreCalled)
{
    EXPECT_EQ(number("mod(7, 3)"), 1);
    EXPECT_EQ(number("mod(-1, 3)"), 2);
    EXPECT_EQ(number("clamp(5, 0, 2)"), 2);
    EXPECT_EQ(number("mix(2, 4, 0.25)"), 2.5);
    EXPECT_EQ(number("smoothstep(0, 2, 1)"), 0.5);
    EXPECT_EQ(number("smoothstep(0, 2, 3)"), 1);
    EXPECT_DOUBLE_EQ(number("radians(180)"), M_PI);
    EXPECT_DOUBLE_EQ(number("degrees(pi)"), 180);
    EXPECT_EQ(number("t < 0.5 ? 3 : 4", {2, 10, {}}), 3);
}

TEST(Motion, RandomNumbersAreTheSameEverywhere)
{
    EXPECT_EQ(number("random(1)"), number("random(1)"));
    EXPECT_NE(number("random(1)"), number("random(2)"));
    EXPECT_NE(number("random(1, 2)"), number("random(2, 1)"));
    EXPECT_EQ(number("random(0)"), number("random(-0)"));
    double sum = 0, squares = 0;
    constexpr int count = 1000;
    for (int i = 0; i < count; ++i) {
        const double x = number("random(7, " + std::to_string(i) + ")");
        ASSERT_GE(x, 0);
        ASSERT_LT(x, 1);
        sum += x;
        squares += x * x;
    }
    EXPECT_NEAR(sum / count, 0.5, 4 * std::sqrt(1.0 / 12 / count));
    EXPECT_NEAR(squares / count, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / count));
}

TEST(Motion, WhatAFrameShowsIsWrittenAsItIs)
{
    const std::string text = "sequence { frames 5; fps 30; loop }\nlight { point [t, 2*frame, random(frame)] }";
    const Scene scene = at(text, {3, 0, {}});
    EXPECT_EQ(read(print_scene(scene)), scene);
}

} // namespace
} // namespace clucida::scene::test
