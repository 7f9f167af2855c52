/// Bad texts: '@' marks the place that the error must name.
#include "test_read_support.h"

#include <vector>

namespace clucida::scene::test {
namespace {

struct Bad {
    std::string text, part;
};

const std::string head = "clucida 1\nobserver { eye [0,-6,2]; look [0,0,0] }\n";

void expect_all(const std::vector<Bad>& table, Format format = Format::clucida, const std::string& before = "")
{
    for (const Bad& bad : table) expect_error(before + bad.text, bad.part, format);
}

TEST(ReadErrors, StatementsThatAreNone)
{
    expect_all({
        {"@", "expected 'clucida 1'"},
        {"@observer { }", "expected 'clucida 1', the language's version, found 'observer'"},
        {"clucida @2", "version 2"},
        {"clucida@", "version"},
        {"clucida 1 @x", "unknown name 'x'"},
        {"clucida 1\n@", "expected an observer"},
    });
    expect_all({{"@clucida 1", "first statement only"},
                {"@objct { }", "did you mean 'object'?"},
                {"@foo { }", "expected let, parameter, settings"},
                {"@42", "expected a statement"},
                {"light { point [0,0,0] } @light { point [0,0,0] }", "expected a new line or ';'"},
                {"@}", "expected a statement"},
                {"@observer { eye [0,0,0]; look [0,1,0] }", "line 2"},
                {"sky rgb\n@sky hsv", "line 3"},
                {"settings { }\n@settings { }", "line 3"}},
               Format::clucida, head);
}

TEST(ReadErrors, BlocksAndTheirEntries)
{
    expect_all({{"light @{ point [0,0,0]", "'{' is never closed"},
                {"light @{", "'{' is never closed"},
                {"light @3", "expected '{'"},
                {"light { @pont [0,0,0] }", "did you mean 'point'?"},
                {"light { point [0,0,0]; @point [0,0,0] }", "line 3 already"},
                {"light { color 1 @}", "expected 'point'"},
                {"light { point [0,0,0] @color 1 }", "expected a new line or ';', found 'color'"},
                {"light { point [0,0,0]; color @-1 }", "no negative light"},
                {"light { @= }", "expected point or color or '}'"},
                {"settings { hops @0 }", "whole number of hops"},
                {"settings { hops @1.5 }", "whole number of hops"},
                {"settings { cutoff @2 }", "cutoff within 0 and 1"},
                {"settings { light_law @lamber }", "did you mean 'lambert'?"},
                {"settings { media @; }", "expected nearest or rank, found ';'"},
                {"sky @blue", "expected color, gradient"},
                {"sky gradient { low 1; high 1 @}", "expected 'middle'"},
                {"sky gradient { low 1; middle 1; high 1; up @[0,0,0] }", "up is 0"},
                {"sky color @[0,-1,0]", "no negative light"}},
               Format::clucida, head);
}

TEST(ReadErrors, Observers)
{
    expect_all({{"observer { eye [0,0,0]; look @[0,0,0] }", "looks at itself"},
                {"observer @{ eye [0,0,0]; look [0,0,1] }", "parallel"},
                {"observer { eye [0,0,0]; look [0,1,0]; up @[0,2,0] }", "parallel"},
                {"observer { eye [0,0,0]; look [0,1,0]; up @[0,0,0] }", "up is 0"},
                {"observer { eye [0,0,0]; look [0,1,0]; fov @180 }", "field of view"},
                {"observer { eye [0,0,0]; look [0,1,0]; fov @0 }", "field of view"},
                {"observer { eye [0,0,0] @}", "expected 'look'"},
                {"observer @windw { }", "did you mean 'window'?"},
                {"observer window { eye [0,0,0]; view [0,1,0]; column @[0,0,0]; row [1,0,0] }", "column is 0"}},
               Format::clucida, "clucida 1\n");
}

TEST(ReadErrors, NumbersAndVectors)
{
    expect_all({{"let @sin = 3", "has a meaning already"},
                {"let @pi = 3", "has a meaning already"},
                {"let a = 1\nlet @a = 2", "line 3 already"},
                {"let @3 = 4", "expected a name"},
                {"let a @3", "expected '='"},
                {"let a =@", "expected a number or a vector"},
                {"let a = @b + 1", "unknown name 'b'"},
                {"let radius = 1\nlet b = 2 * @radios", "did you mean 'radius'?"},
                {"let v = [1,2,3]\nlet b = 2 * @v", "'v' is a vector"},
                {"let b = 1\nlight { point @b }", "'b' is a number"},
                {"light { point @c }", "unknown vector 'c'"},
                {"light { point @3 }", "expected a vector"},
                {"light { point [1, 2@] }", "third of three"},
                {"light { point [1, 2, 3@, 4] }", "expected ']'"},
                {"light { point [1, @, 3] }", "expected a number, found ','"},
                {"let a = @1/0", "finite"},
                {"let a = @sqrt(-1)", "finite"},
                {"let a = @1e39", "out of range"},
                {"let a = @1e-39", "out of range"},
                {"let a = @1e999", "out of range"},
                {"let a = 1 +@", "expected an arithmetic expression"},
                {"let a = 1 * @* 2", "expected an arithmetic expression"},
                {"let a = @(1 + 2", "'(' is never closed"},
                {"let a = 1 @= 2", "'=' in an expression"},
                {"let a = 3 @\"x\"", "expected a new line"},
                {"let a = @rnd()", "unknown name 'rnd'"},
                {"let a = @nan", "unknown name 'nan'"}},
               Format::clucida, head);
}

TEST(ReadErrors, Solids)
{
    expect_all({{"solid a = @b", "unknown solid 'b'"},
                {"solid a = @sfere([0,0,0], 1)", "did you mean 'sphere'?"},
                {"solid @sphere = sphere([0,0,0], 1)", "has a meaning already"},
                {"solid a = sphere([0,0,0],1)\nsolid @a = sphere([0,0,0],1)", "line 3 already"},
                {"solid a = torus([0,0,0], @[0,0,0], 2, 1)", "axis is 0"},
                {"solid a = torus([0,0,0], [0,0,1], @0, 1)", "major radius above 0"},
                {"solid a = torus([0,0,0], [0,0,1], 2, @-1)", "minor radius above 0"},
                {"solid a = torus([0,0,0], [0,0,1], 2, @2)", "minor radius below the major, 2"},
                {"solid a = torus([0,0,0], [0,0,1], 2@)", "another argument of torus"},
                {"solid a = quadric(@1)", "the factors of x^2, y^2, z^2, a vector"},
                {"solid a = quadric([1,1,1], [0,0,0], [0,0,0], @)", "the constant, a number"},
                {"solid a = quadric(@[0,0,0], [0,0,0], [0,0,0], 1)", "no boundary"},
                {"solid a = quadric(@[0,0,0], [0,0,0], [0,0,0], -1)", "no boundary"},
                {"solid a = quadric(@[1,2,3], [0,0,0], [0,0,0], 1)", "no boundary"},
                {"solid a = quadric(@[-1,-2,-3], [0,0,0], [0,0,0], 0)", "no boundary"},
                {"solid a = quadric(@[1,1,0], [0,0,0], [-2,0,0], 1)", "no boundary"},
                {"solid a = quadric(@[1,1,0], [2,0,0], [0,0,0], 0)", "no boundary"},
                {"solid a = @-sphere([0,0,0], 1)", "complement"},
                {"solid a = sphere@", "expected '(' after 'sphere'"},
                {"solid a = sphere @3", "expected '('"},
                {"solid a = sphere([0,0,0]@)", "another argument of sphere"},
                {"solid a = sphere([0,0,0], @)", "the radius, a number"},
                {"solid a = sphere([0,0,0], @0)", "radius above 0"},
                {"solid a = sphere([0,0,0], @-1)", "radius above 0"},
                {"solid a = sphere(@1, 1)", "the center, a vector"},
                {"solid a = sphere([0,0,0], 1@, 2)", "expected ')'"},
                {"solid a = plane([0,0,0], @[0,0,0])", "normal is 0"},
                {"solid a = cylinder([0,0,0], [0,0,1], @0)", "radius above 0"},
                {"solid a = cylinder([0,0,0], @[0,0,0], 1)", "axis is 0"},
                {"solid a = cone([0,0,0], @[0,0,0])", "axis is 0"},
                {"solid a = paraboloid([0,0,0], @[0,0,0])", "focus is 0"},
                {"solid a = hyperboloid([0,0,0], [0,0,1], @0)", "waist above 0"},
                {"solid a = saddle([0,0,0], [0,0,1], @[0,0,-2])", "parallel"},
                {"solid a = cuboid([0,0,0], [0,0,1], @[0,0,1], [1,1,1])", "parallel"},
                {"solid a = cuboid([0,0,0], @[1,-1,1])", "sizes above 0"},
                {"solid a = cuboid([0,0,0], @[0,0,0])", "unbounded"},
                {"solid a = rotate(@[0,0,0], 3, sphere([0,0,0],1))", "axis is 0"},
                {"solid a = scale(@0, sphere([0,0,0],1))", "flatten"},
                {"solid a = scale(@[1,0,1], sphere([0,0,0],1))", "flatten"},
                {"solid a = move([0,0,1]@)", "another argument of move"},
                {"solid a = (sphere([0,0,0],1)@}", "expected ')'"},
                {"solid a = sphere([0,0,0],1) & @& sphere([0,0,0],1)", "expected a solid, found '&'"},
                {"solid a = sphere([0,0,0],1)\n@& sphere([0,0,0],1)", "expected a statement"},
                {"solid a = @(sphere([0,0,0],1)", "'(' is never closed"},
                {"solid a =@\n", "expected a solid, found the end of the line"}},
               Format::clucida, head);
}

TEST(ReadErrors, ObjectsOpticsAndTextures)
{
    expect_all({{"object { optics { } @}", "expected 'solid'"},
                {"object { solid sphere([0,0,0],1) @}", "expected 'optics'"},
                {"object { solid sphere([0,0,0],1); optics @glass }", "unknown optics 'glass'"},
                {"optics glass { }\nobject { solid sphere([0,0,0],1); optics @glas }", "did you mean 'glass'?"},
                {"optics glass { }\noptics @glass { }", "line 3 already"},
                {"optics @{ }", "expected a name"},
                {"optics a { reflection @1.5 }", "within 0 and 1"},
                {"optics a { passthrough @[1,1,-.1] }", "within 0 and 1"},
                {"optics a { fresnel @1 }", "expected a new line or ';'"},
                {"object a { solid sphere([0,0,0],1); optics { } }\nobject @a { }", "line 3 already"},
                {"texture t { photograph @quad }", "double quotes"},
                {"texture t { photograph @\"none.ppm\" }", "no photograph 'none.ppm'"},
                {"texture t { photograph @\"quad.ppm", "never closed"},
                {"texture t { photograph \"a\\@n\" }", "after '\\'"},
                {"texture t { photograph @\"\" }", "expected the path"},
                {"texture t { photograph @\"../scenes/none.ppm\" }", "no photograph"},
                {"texture t { photograph @\"../../x.ppm\" }", "leads out"},
                {"texture t { photograph @\"/etc/hostname\" }", "leads out"},
                {"texture t { photograph @\".\" }", "is no file"},
                {"texture t { photograph \"quad.ppm\" @}", "expected 'mapping'"},
                {"texture t { mapping @flat { } }", "expected directional"},
                {"texture t { mapping directional { n @[0,0,0] } }", "n is 0"},
                {"texture t { mapping planar { origin [0,0,0]; u [1,0,0]; v @[2,0,0] } }", "parallel"},
                {"texture t { mapping relative { n [0,0,1] @} }", "expected 'origin'"},
                {"texture t { wrap [1@] }", "second of two"}},
               Format::clucida, head);
}

TEST(ReadErrors, Gun)
{
    const std::string eye = "0 -4 1 0 0 0 1 0 0 0 0 -1\n";
    const std::string optics = " 0 0 0 1 1 1 0 0 0 0 1 1 1\n";
    expect_all({{"@", "expected a number (the eye), found the end of the text"},
                {"0 0 @x", "found 'x'"},
                {"0 0 @0,1", "found '0,1'"},
                {"0 0 @0x1", "found '0x1'"},
                {"0 0 @nan", "found 'nan'"},
                {"0 0 @inf", "found 'inf'"},
                {"0 0 @1e", "found '1e'"},
                {"0 0 @+-1", "found '+-1'"},
                {"0 0 @1e999", "found '1e999'"},
                {"0 0 @1e-40", "out of range"},
                {"0 -4 1 @0 -4 1 1 0 0 0 0 1", "looks at itself"},
                {"0 -4 1 0 0 0 1 0 0 @0 0 0 1", "the row is 0"}},
               Format::gun);
    expect_all({{"@0 0 0", "the number of objects"},
                {"@1000000000 0 0", "within 1 and 4000000"},
                {"@99999999999999999999999 0 0", "within 1 and 4000000"},
                {"@1.5 0 0", "whole number"},
                {"@-1 0 0", "whole number"},
                {"@1 2 2", "1 objects cannot be 2 intersections"},
                {"1 0 0 @-plane 0 0 0 0 0 1" + optics, "found '-plane'"},
                {"1 0 0 @Sphere 0 0 0 1" + optics, "found 'Sphere'"},
                {"1 0 0 @parabol 0 0 0 0 0 1" + optics, "found 'parabol'"},
                {"1 0 0 sphere 0 0 0 @0" + optics, "radius above 0"},
                {"1 0 0 plane 0 0 0 @0 0 0" + optics, "normal is 0"},
                {"1 1 1 x 1 @x 1 sphere 0 0 0 1" + optics, "found 'x'"},
                {"1 1 0 x @0" + optics, "number of members"},
                {"1 1 0 x @65537" + optics, "number of members"},
                {"1 @1 0 sphere 0 0 0 1" + optics + "rgb 0", "have 0 intersections; expected 1"},
                {"1 1 @1 x 2 sphere 0 0 0 1 sphere 0 0 0 2" + optics + "rgb 0", "have 2 members; expected 1"},
                {"1 0 0 sphere 0 0 0 1 @spherical 1 2 3", "expected directional"},
                {"1 0 0 sphere 0 0 0 1 directional @0 0 0 quad.ppm", "n is 0"},
                {"1 0 0 sphere 0 0 0 1 directional 0 0 1 @nothing.ppm", "no photograph"},
                {"1 0 0 sphere 0 0 0 1 directional 0 0 1 quad.ppm 0 0 @-1 0 0", "no negative light"},
                {"1 0 0 sphere 0 0 0 1 @0 0 1.5", "within 0 and 1"},
                {"1 0 0 sphere 0 0 0 1 0 0 0 1 1 1 0 0 0 0 @1 2 1", "passthrough is 2"},
                {"1 0 0 sphere 0 0 0 1" + optics + "@", "expected the sky"},
                {"1 0 0 sphere 0 0 0 1" + optics + "@hsv 0", "no photograph 'hsv'"},
                {"1 0 0 sphere 0 0 0 1" + optics + "@../../quad.ppm 0", "leads out"},
                {"1 0 0 sphere 0 0 0 1" + optics + "rgb @65537", "number of lights"},
                {"1 0 0 sphere 0 0 0 1" + optics + "rgb 1 0 0 0 1 1@", "the light's color"},
                {"1 0 0 sphere 0 0 0 1" + optics + "rgb 1 0 0 0 @-1 1 1", "no negative light"},
                {"1 0 0 sphere 0 0 0 1" + optics + "rgb 0\n@0", "nothing after the lights"}},
               Format::gun, eye);
}

TEST(ReadErrors, Rayt)
{
    const std::string optics = " optics 0 0 0 1 1 1 0 0 0 0 1 1 1\n";
    expect_all({{"0 0 0 0 1 0 @0 2 0 0", "parallel"},
                {"0 0 0 0 1 0 @0 0 0 0", "column is 0"},
                {"0 0 0 @0 0 0 1 0 0 0", "looks at itself"}},
               Format::rayt);
    expect_all({{"@4000001", "number of objects"},
                {"1 @-x 1", "found '-x'"},
                {"1 @--sphere 0 0 0 1" + optics, "found '--sphere'"},
                {"1 sphere 0 0 0 1 @0 0 0", "expected 'optics'"},
                {"1 saddle 0 0 0 0 0 1 @0 0 2" + optics, "parallel"},
                {"1 cuboid 0 0 0 0 0 1 @0 0 2 1 1 1" + optics, "parallel"},
                {"1 cuboid 0 0 0 0 0 1 1 0 0 @0 0 0" + optics, "unbounded"},
                {"1 hyperbol 0 0 0 0 0 1 @0" + optics, "waist above 0"},
                {"1 parabol 0 0 0 @0 0 0" + optics, "focus is 0"},
                {"0 @color 1 1 1 0", "no photograph 'color'"},
                {"0 rgb 0 @.", "nothing after the lights"}},
               Format::rayt, "0 0 0 0 1 0 1 0 0\n");
}

TEST(ReadErrors, TheOffendingLineIsShownWithACaret)
{
    const auto error = error_of("clucida 1\n\tsky photograph \"\xC3\xA9\\n\"\n");
    ASSERT_TRUE(error.has_value());
    EXPECT_STREQ(error->what(), "scene:2:21: error: expected '\"' or '\\' after '\\' in a string\n"
                                "\tsky photograph \"\xC3\xA9\\n\"\n\t                  ^");
}

TEST(ReadErrors, ALongLineIsCutAroundTheColumn)
{
    const auto error = error_of("clucida 1\nlet a = [" + std::string(100'000, ' ') + "?" + std::string(100'000, ' '));
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->at.column, 100'010U);
    const std::string what = error->what();
    EXPECT_LT(what.size(), 500U);
    const std::string shown = what.substr(what.find('\n') + 1);
    EXPECT_EQ(shown.find('?'), shown.find('^') - shown.find('\n') - 1);
}

TEST(ReadErrors, AnErrorOfTheCompilersCanBeLocatedInTheText)
{
    const Error error = located(Error(Location{2, 3}, "too large"), "a.clucida", "one\ntwo\n");
    EXPECT_STREQ(error.what(), "a.clucida:2:3: error: too large\ntwo\n  ^");
    EXPECT_EQ(error.at.line, 2U);
}

} // namespace
} // namespace clucida::scene::test
