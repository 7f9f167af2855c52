// From solids to groups, programs and bounds: the same set of points, held in a sphere.
#include "native_scene.h"

#include "scene/bounds.h"
#include "scene/error.h"
#include "scene/normal_form.h"

#include <functional>

namespace clucida::test {
namespace {

using scene::dot;
using scene::length;

/// A random tree of spheres, planes, cuboids and cylinders, and membership by their definitions.
struct Tree {
    SolidPtr solid;
    std::function<bool(Vec3)> holds;
};

/// By its sum. Half of them have factors of 0 or 1, so that all kinds come up, planes too.
Tree random_quadric(Random& random)
{
    scene::FreeQuadric quadric;
    auto& q = quadric.q;
    do {
        const bool whole = random() % 2 == 0;
        for (double& x : q) x = whole ? std::round(uniform(random, -1.4, 1.4)) : uniform(random, -1, 1);
        if (random() % 2 == 0) q[3] = q[4] = q[5] = 0;
    } while (!scene::has_boundary(quadric));
    return {solid(quadric), [q](Vec3 p) {
                return q[0] * p.x * p.x + q[1] * p.y * p.y + q[2] * p.z * p.z + q[3] * p.x * p.y + q[4] * p.x * p.z +
                           q[5] * p.y * p.z + q[6] * p.x + q[7] * p.y + q[8] * p.z + q[9] <
                       0;
            }};
}

Tree random_leaf(Random& random, bool tori = false)
{
    const Vec3 c = random_in_box(random, 1), n = scene::unit(random_in_box(random, 1));
    const double r = uniform(random, .4, 1.2);
    switch (random() % 8) {
    case 0: return {plane(c, n * r), [=](Vec3 p) { return dot(p - c, n) < 0; }};
    case 1:
        return {cuboid(c, {r, 1, 2 * r}), [=](Vec3 p) {
                    return std::fabs(p.x - c.x) < r / 2 && std::fabs(p.y - c.y) < .5 && std::fabs(p.z - c.z) < r;
                }};
    case 2: return {solid(scene::Cylinder{c, n * r}), [=](Vec3 p) { return length(scene::cross(p - c, n)) < r; }};
    case 3:
        return {solid(scene::Cone{c, n * r}),
                [=](Vec3 p) { return length(scene::cross(p - c, n)) < std::fabs(dot(p - c, n)) / r; }};
    case 4:
        return {solid(scene::Paraboloid{c, n * r}), [=](Vec3 p) {
                    const double z = dot(p - c, n), across = length(scene::cross(p - c, n));
                    return across * across < 4 * r * z;
                }};
    case 5: return random_quadric(random);
    case 6: return {sphere(c, r), [=](Vec3 p) { return length(p - c) < r; }};
    default: // a torus, or a ball for what is stretched, which a torus may not be
        if (!tori) return {sphere(c, r), [=](Vec3 p) { return length(p - c) < r; }};
        return {solid(scene::Torus{c, n * 3, r, r * .4}), [=](Vec3 p) {
                    const double z = dot(p - c, n), across = length(p - c - n * z) - r;
                    return across * across + z * z < .16 * r * r;
                }};
    }
}

Tree transformed(Random& random, const Tree& a)
{
    const Vec3 by = random_in_box(random, 1);
    switch (random() % 3) {
    case 0: return {solid(scene::Transformed{scene::Move{by}, a.solid}), [=](Vec3 p) { return a.holds(p - by); }};
    case 1: {
        const Vec3 s{.5 + std::fabs(by.x), -.5 - std::fabs(by.y), .75};
        return {solid(scene::Transformed{scene::Scale{s}, a.solid}), [=](Vec3 p) {
                    return a.holds({p.x / s.x, p.y / s.y, p.z / s.z});
                }};
    }
    default: // right-handed about z by 90 degrees: x to y
        return {solid(scene::Transformed{scene::Rotate{{0, 0, 2}, 90}, a.solid}), [=](Vec3 p) {
                    return a.holds({p.y, -p.x, p.z});
                }};
    }
}

Tree random_tree(Random& random, int depth)
{
    if (depth == 0) return random_leaf(random);
    const Tree a = random_tree(random, depth - 1);
    const auto kind = random() % 6;
    if (kind == 0) return {complement(a.solid), [=](Vec3 p) { return !a.holds(p); }};
    if (kind == 1) return transformed(random, a);
    const Tree b = random_tree(random, static_cast<int>(random() % static_cast<unsigned>(depth)));
    if (kind < 4)
        return {solid(scene::Intersection{{a.solid, b.solid}}), [=](Vec3 p) { return a.holds(p) && b.holds(p); }};
    if (kind == 4) return {solid(scene::Union{{a.solid, b.solid}}), [=](Vec3 p) { return a.holds(p) || b.holds(p); }};
    return {solid(scene::Difference{a.solid, b.solid}), [=](Vec3 p) { return a.holds(p) && !b.holds(p); }};
}

TEST(CompileSolids, TheNormalFormHoldsThePointsThatTheTreeHolds)
{
    Random random(1);
    unsigned unsure = 0, held = 0;
    for (int i = 0; i < 2000; i++) {
        const Tree tree = random_tree(random, 1 + i % 5);
        const scene::Form form = scene::normal_form(*tree.solid);
        for (int k = 0; k < 100; k++) {
            const Vec3 p = random_in_box(random, 2.5);
            const std::optional<bool> inside = scene::holds(form, p, 1e-9);
            if (inside)
                ASSERT_EQ(*inside, tree.holds(p)) << "tree " << i;
            else
                unsure++;
            held += tree.holds(p) ? 1 : 0;
        }
    }
    EXPECT_LT(unsure, 20U);
    EXPECT_GT(held, 50000U);
}

TEST(CompileSolids, AUnionCutByAConvexSolidIsAFlatUnion)
{
    const SolidPtr cut = solid(scene::Intersection{
        {solid(scene::Union{{sphere({1, 0, 0}, 1), sphere({-1, 0, 0}, 1)}}), cuboid({0, 0, 0}, {2, 2, 2})}});
    for (const bool turned : {false, true}) {
        const scene::Form form = scene::normal_form(*(turned ? complement(cut) : cut));
        EXPECT_EQ(form.kind, turned ? scene::Form::Kind::all : scene::Form::Kind::any);
        ASSERT_EQ(form.parts.size(), 2U);
        for (const scene::Form& part : form.parts) {
            EXPECT_EQ(part.kind, scene::Form::Kind::group);
            EXPECT_EQ(part.group.inverse, turned);
            EXPECT_EQ(part.group.members.size(), 7U);
        }
    }
}

TEST(CompileSolids, ToriAndFreeQuadricsHoldThePointsOfTheirFormulas)
{
    Random random(6);
    unsigned unsure = 0, bounded = 0;
    for (int i = 0; i < 4000; i++) {
        Tree tree = i % 2 == 0 ? random_quadric(random) : random_leaf(random, true);
        if (i % 4 == 2) tree = transformed(random, tree);
        if (i % 3 == 0) tree = {complement(tree.solid), [tree](Vec3 p) { return !tree.holds(p); }};
        const scene::Form form = scene::normal_form(*tree.solid);
        const scene::BoundingSphere bound = scene::bounds_of(form).sphere;
        bounded += bound.radius < scene::unbounded ? 1 : 0;
        for (int k = 0; k < 100; k++) {
            const Vec3 p = random_in_box(random, 2.5);
            const std::optional<bool> inside = scene::holds(form, p, 1e-9);
            if (inside)
                ASSERT_EQ(*inside, tree.holds(p)) << "solid " << i;
            else
                unsure++;
            if (tree.holds(p)) {
                ASSERT_LE(length(p - bound.center), bound.radius * (1 + 1e-9)) << "solid " << i;
            }
        }
    }
    EXPECT_LT(unsure, 20U);
    EXPECT_GT(bounded, 500U);
}

TEST(CompileSolids, ATorusIsTwoPartsOfOnePrimitiveAndMayBeTurnedMovedMirroredAndScaled)
{
    const SolidPtr ring = solid(scene::Torus{{1, 2, 3}, {0, 0, 5}, 2, .5});
    const Native native(scene_of({solid(
        scene::Transformed{scene::Move{{1, 0, 0}},
                           solid(scene::Transformed{scene::Rotate{{1, 0, 0}, 90},
                                                    solid(scene::Transformed{scene::Scale{{-2, 2, 2}}, ring})})})}));
    ASSERT_EQ(native.items<LayoutTorus>(BUFFER_TORI).size(), 1U);
    const LayoutTorus& torus = native.items<LayoutTorus>(BUFFER_TORI)[0];
    const LayoutObject& object = native.items<LayoutObject>(BUFFER_OBJECTS)[0];
    EXPECT_EQ(torus.major, 4);
    EXPECT_EQ(torus.minor, 1);
    EXPECT_NEAR(object.center[0] + torus.c[0], -1, 1e-6);
    EXPECT_NEAR(object.center[1] + torus.c[1], -6, 1e-6);
    EXPECT_NEAR(object.center[2] + torus.c[2], 4, 1e-6);
    EXPECT_EQ(std::fabs(torus.axis[1]), 1);
    EXPECT_NEAR(object.radius, 5, 1e-4);
    const auto members = native.items<u32>(BUFFER_MEMBERS);
    ASSERT_EQ(members.size(), 2U);
    EXPECT_EQ(members[0] ^ members[1], MEMBER_PART);
}

TEST(CompileSolids, AnObjectOfOneMemberNamesItAndNoOther)
{
    const SolidPtr ball = sphere({1, 2, 3}, 1), half = plane({1, 2, 3}, {0, 0, 1});
    const Native native(scene_of({half, ball, complement(ball), solid(scene::Intersection{{ball, half}}),
                                  solid(scene::Union{{ball, half}}), cuboid({0, 0, 0}, {1, 1, 1})}));
    const auto objects = native.items<LayoutObject>(BUFFER_OBJECTS);
    const auto members = native.items<u32>(BUFFER_MEMBERS);
    for (const std::size_t i : {0U, 1U})
        EXPECT_EQ(objects[i].sole, members[native.items<LayoutGroup>(BUFFER_GROUPS)[objects[i].group_begin].begin]);
    for (const std::size_t i : {3U, 4U, 5U}) EXPECT_EQ(objects[i].sole, MEMBER_NONE) << i;
    EXPECT_TRUE(objects[2].sole == MEMBER_NONE || (objects[2].sole & MEMBER_INVERSE) != 0);
}

TEST(CompileSolids, ASlabOrAHalfSpaceWrittenAsAQuadricIsMadeOfPlanes)
{
    const auto planes = [](std::array<double, 10> q) {
        const scene::Form form = scene::normal_form(*solid(scene::FreeQuadric{q}));
        EXPECT_EQ(form.kind, scene::Form::Kind::group);
        for (const scene::Member& m : form.group.members) EXPECT_TRUE(std::holds_alternative<scene::HalfSpace>(m));
        return form.group.members.size();
    };
    EXPECT_EQ(planes({0, 0, 0, 0, 0, 0, 0, 0, 2, -1}), 1U);
    EXPECT_EQ(planes({0, 0, 1, 0, 0, 0, 0, 0, 0, -1}), 2U);
    EXPECT_EQ(planes({0, -1, 0, 0, 0, 0, 0, 2, 0, 3}), 2U);
}

TEST(CompileSolids, AMarginMakesPointsNearABoundaryUnsure)
{
    const scene::Form form = scene::normal_form(*sphere({0, 0, 0}, 1));
    EXPECT_EQ(scene::holds(form, {.5, 0, 0}, .25), true);
    EXPECT_EQ(scene::holds(form, {1.5, 0, 0}, .25), false);
    EXPECT_EQ(scene::holds(form, {.99, 0, 0}, .25), std::nullopt);
    EXPECT_EQ(scene::holds(form, {1.01, 0, 0}, .25), std::nullopt);
}

TEST(CompileSolids, BoundsHoldTheirSolids)
{
    Random random(2);
    unsigned bounded = 0, held = 0;
    for (int i = 0; i < 3000; i++) {
        const Tree tree = random_tree(random, 1 + i % 4);
        const auto [bound, box] = scene::bounds_of(scene::normal_form(*tree.solid));
        if (!(bound.radius < scene::unbounded)) continue;
        bounded++;
        for (int k = 0; k < 300; k++) {
            const Vec3 p = bound.center + random_in_box(random, 1.25 * bound.radius);
            if (!tree.holds(p)) continue;
            held++;
            ASSERT_LE(length(p - bound.center), bound.radius * (1 + 1e-9)) << "tree " << i;
            for (int axis = 0; axis < 3; axis++) {
                ASSERT_GE(component(p, axis), component(box.low, axis) - 1e-9) << "tree " << i;
                ASSERT_LE(component(p, axis), component(box.high, axis) + 1e-9) << "tree " << i;
            }
        }
    }
    EXPECT_GT(bounded, 1000U);
    EXPECT_GT(held, 10000U);
}

double radius_of(const SolidPtr& s)
{
    return scene::bounds_of(scene::normal_form(*s)).sphere.radius;
}

SolidPtr both(std::vector<SolidPtr> of)
{
    return solid(scene::Intersection{std::move(of)});
}

TEST(CompileSolids, SolidsThatEndHaveAFiniteBound)
{
    const SolidPtr slab = both({plane({0, 0, 1}, {0, 0, 1}), plane({0, 0, -1}, {0, 0, -1})});
    const SolidPtr above = plane({0, 0, 2}, {.1, 0, 1});
    EXPECT_LT(radius_of(sphere({9, 9, 9}, 1)), 1.001);
    EXPECT_LT(radius_of(cuboid({9, 9, 9}, {2, 2, 2})), 1.001 * std::sqrt(3));
    EXPECT_LT(radius_of(solid(scene::Cuboid{{9, 9, 9}, {1, 2, 3}, {0, 1, 0}, {2, 2, 2}})), 2 * std::sqrt(3));
    EXPECT_LT(radius_of(both({solid(scene::Cylinder{{0, 0, 0}, {0, 0, .5}}), slab})), 2 * std::hypot(1, .5));
    EXPECT_LT(radius_of(both({solid(scene::Cylinder{{0, 0, 0}, {.1, 0, .5}}), slab})), 4);
    EXPECT_LT(radius_of(both({solid(scene::Cone{{0, 0, 0}, {0, 0, 2}}), slab})), 2 * std::hypot(1, .5));
    EXPECT_LT(radius_of(both({solid(scene::Paraboloid{{0, 0, 0}, {0, 0, .25}}), above})), 10);
    EXPECT_LT(radius_of(both({solid(scene::Hyperboloid{{0, 0, 0}, {0, 0, 1}, 1}), slab})), 2 * std::hypot(1, 1.5));
    EXPECT_LT(radius_of(solid(scene::Transformed{scene::Scale{{1, 2, 3}}, sphere({0, 0, 0}, 1)})), 2 * std::sqrt(14));
    // A tetrahedron, and what is cut from, joined to and turned about bounded ones.
    EXPECT_LT(radius_of(both({plane({0, 0, 0}, {-1, 0, 0}), plane({0, 0, 0}, {0, -1, 0}), plane({0, 0, 0}, {0, 0, -1}),
                              plane({1, 0, 0}, {1, 1, 1})})),
              2);
    const SolidPtr ball = sphere({0, 0, 0}, 1);
    EXPECT_LT(radius_of(solid(scene::Difference{ball, slab})), 1.001);
    EXPECT_LT(radius_of(solid(scene::Union{{ball, sphere({4, 0, 0}, 1)}})), 2 * 3);
    EXPECT_LT(radius_of(both({ball, complement(both({slab, solid(scene::Cone{{0, 0, 0}, {0, 0, 2}})}))})), 1.001);
    EXPECT_LT(radius_of(solid(scene::Transformed{scene::Rotate{{1, 2, 3}, 50}, cuboid({0, 0, 0}, {2, 2, 2})})),
              2 * std::sqrt(3));
}

TEST(CompileSolids, ADishIsBoundedByItsHollowAndItsRim)
{
    // y > x^2 + z^2, less y > 2 + x^2/2 + z^2/2
    const SolidPtr out = solid(scene::Paraboloid{{0, 0, 0}, {0, .25, 0}}),
                   in = solid(scene::Paraboloid{{0, 2, 0}, {0, .5, 0}});
    const auto cut = [&](Vec3 point, Vec3 axis) {
        return scene::bounds_of(scene::normal_form(*both({out, complement(in), solid(scene::Cylinder{point, axis})})));
    };
    const scene::Bounds bound = cut({.5, -7, 0}, {0, -.5, 0});
    EXPECT_LT(bound.sphere.radius, 2);
    for (const Vec3 p : {Vec3{1, 1, 0}, Vec3{1, 2.49, 0}, Vec3{.5, 2.3, .5}, Vec3{0, 0, 0}, Vec3{0, 1.99, 0}}) {
        EXPECT_LE(length(p - bound.sphere.center), bound.sphere.radius) << p.x;
        EXPECT_LE(bound.box.low.y, p.y);
        EXPECT_GE(bound.box.high.y, p.y);
    }
    EXPECT_FALSE(cut({0, 0, 0}, {0, 1, .01}).sphere.radius < scene::unbounded);
    EXPECT_FALSE(radius_of(both({out, solid(scene::Cylinder{{0, 0, 0}, {0, 1, 0}})})) < scene::unbounded);
}

TEST(CompileSolids, SolidsWithoutEndHaveNoBound)
{
    const SolidPtr slab = both({plane({0, 0, 1}, {0, 0, 1}), plane({0, 0, -1}, {0, 0, -1})});
    for (const SolidPtr& s :
         {plane({0, 0, 0}, {0, 0, 1}), slab, cuboid({0, 0, 0}, {1, 1, 0}), complement(sphere({0, 0, 0}, 1)),
          solid(scene::Cylinder{{0, 0, 0}, {0, 0, 1}}),
          both({solid(scene::Cylinder{{0, 0, 0}, {0, 0, 1}}), plane({0, 0, 0}, {0, 0, 1})}),
          both({solid(scene::Cone{{0, 0, 0}, {0, 0, 1}}), plane({1, 0, 0}, {1, 0, 0})}),
          both({solid(scene::Cone{{0, 0, 0}, {0, 0, 1}}), solid(scene::Hyperboloid{{0, 0, 0}, {0, 0, 1}, 1})}),
          solid(scene::Union{{sphere({0, 0, 0}, 1), plane({0, 0, 0}, {0, 0, 1})}}),
          both({solid(scene::Paraboloid{{0, 0, 0}, {0, 0, 1}}), plane({1, 0, 0}, {1, 0, 0})})})
        EXPECT_FALSE(radius_of(s) < scene::unbounded);
}

/// Runs an object's program on the groups' bits; tells how deep its stack gets.
struct Outcome {
    bool inside = false;
    std::size_t deepest = 0;
};
Outcome run(const Native& scene, const LayoutObject& object, const std::function<bool(u32)>& group)
{
    const auto programs = scene.items<u32>(BUFFER_PROGRAMS);
    std::vector<bool> stack;
    Outcome result;
    for (u32 i = 0; i < object.program_count; i++) {
        const u32 op = programs[object.program_begin + i], n = op >> OP_SHIFT;
        if ((op & OP_MASK) == OP_GROUP) {
            EXPECT_LT(n, object.group_count);
            stack.push_back(group(n));
        } else {
            EXPECT_LE(n, stack.size());
            bool value = (op & OP_MASK) == OP_AND;
            for (u32 k = 0; k < n; k++) {
                value = (op & OP_MASK) == OP_AND ? value && stack.back() : value || stack.back();
                stack.pop_back();
            }
            stack.push_back(value);
        }
        result.deepest = std::max(result.deepest, stack.size());
    }
    EXPECT_EQ(stack.size(), 1U);
    result.inside = stack.back();
    return result;
}

TEST(CompileSolids, ProgramsOfAThousandLeavesStayWithinTheStackHoweverNested)
{
    Random random(3);
    const auto leaf = [&] { return sphere(random_in_box(random, 10), uniform(random, .1, 1)); };
    const auto joined = [](bool any, SolidPtr a, SolidPtr b) {
        return any ? solid(scene::Union{{std::move(a), std::move(b)}})
                   : solid(scene::Difference{std::move(a), std::move(b)});
    };
    const std::function<SolidPtr(int, bool)> balanced = [&](int depth, bool any) {
        return depth == 0 ? leaf() : joined(any, balanced(depth - 1, !any), balanced(depth - 1, !any));
    };
    SolidPtr left = leaf(), right = leaf(), zigzag = leaf();
    for (int i = 1; i < 1000; i++) {
        left = joined(i % 2, left, leaf());
        right = joined(i % 2, leaf(), right);
        zigzag = i % 4 < 2 ? joined(i % 2, zigzag, leaf()) : joined(i % 2, leaf(), zigzag);
    }
    for (const SolidPtr& s : {left, right, zigzag, balanced(9, true), balanced(9, false)}) {
        const Native scene(scene_of({s}));
        const LayoutObject& object = scene.items<LayoutObject>(BUFFER_OBJECTS)[0];
        ASSERT_GT(object.program_count, 500U);
        const Outcome result = run(scene, object, [&](u32) { return random() % 2 != 0; });
        EXPECT_LE(result.deepest, std::size_t{PROGRAM_MAX_DEPTH});
    }
}

TEST(CompileSolids, ProgramsSayWhatTheTreeSays)
{
    Random random(4);
    unsigned programs = 0;
    for (int i = 0; i < 1000; i++) {
        const Tree tree = random_tree(random, 2 + i % 4);
        const Native scene(scene_of({tree.solid}));
        const LayoutObject& object = scene.items<LayoutObject>(BUFFER_OBJECTS)[0];
        if (object.program_count == 0) continue;
        programs++;
        for (int k = 0; k < 20; k++) {
            const Vec3 p = random_in_box(random, 2.5);
            const std::vector<u32> in(tree.holds(p) ? 1 : 0, 0U);
            // A wrong interior shows as a parity fault at the start.
            Stats stats{};
            next_hit<Double>(scene, {p, {0, 0, 1}, MEMBER_NONE, false}, in, stats);
            ASSERT_EQ(stats[STAT_PARITY], 0U) << "tree " << i;
        }
    }
    EXPECT_GT(programs, 100U);
}

TEST(CompileSolids, SharedPrimitivesAreStoredOnceInAnObject)
{
    const SolidPtr a = sphere({0, 0, 0}, 1), b = sphere({1, 0, 0}, 1), c = cuboid({0, 0, 0}, {1, 1, 1});
    const SolidPtr tree = solid(scene::Union{{both({a, c}), both({complement(a), b}), both({b, complement(c)})}});
    const Native scene(scene_of({tree}));
    EXPECT_EQ(scene.items<LayoutSphere>(BUFFER_SPHERES).size(), 2U);
    EXPECT_EQ(scene.items<LayoutPlane>(BUFFER_PLANES).size(), 6U);
    const auto same = scene::normal_form(*both({a, a, a}));
    EXPECT_EQ(same.kind, scene::Form::Kind::group);
    EXPECT_EQ(same.group.members.size(), 1U);
}

/// The error of compiling one solid, its place line 7.
std::string error_of(SolidPtr s, scene::Location& at)
{
    Scene scene = scene_of({std::move(s)});
    scene.objects[0].at = {7, 3};
    try {
        scene::compile(scene, {});
    } catch (const scene::Error& error) {
        at = error.at;
        return error.what();
    }
    return "";
}

TEST(CompileSolids, WhatIsTooLargeOrFlatIsAnErrorThatNamesItsPlace)
{
    Random random(5);
    scene::Location at;
    std::vector<SolidPtr> many;
    for (int i = 0; i < 1025; i++) many.push_back(sphere(random_in_box(random, 10), 1));
    EXPECT_NE(error_of(solid(scene::Union{many}), at).find("1025"), std::string::npos);
    EXPECT_EQ(at.line, 7U);
    many.pop_back();
    EXPECT_EQ(error_of(solid(scene::Union{many}), at), "");
    SolidPtr doubled = sphere({0, 0, 0}, 1);
    for (int i = 0; i < 40; i++) doubled = solid(scene::Union{{doubled, doubled}});
    EXPECT_NE(error_of(doubled, at).find("too many"), std::string::npos);
    EXPECT_EQ(at.line, 7U);
    const SolidPtr flat =
        scene::make_solid(scene::Transformed{scene::Scale{{1e-15, 1e-15, 1e-15}}, sphere({0, 0, 0}, 1)}, {9, 2});
    EXPECT_NE(error_of(flat, at).find("flattens"), std::string::npos);
    EXPECT_EQ(at.line, 9U);
    const SolidPtr ring = scene::make_solid(scene::Torus{{0, 0, 0}, {0, 0, 1}, 2, 1}, {3, 3});
    const SolidPtr turned = scene::make_solid(scene::Transformed{scene::Rotate{{1, 0, 0}, 30}, ring}, {3, 2});
    const SolidPtr egg = scene::make_solid(scene::Transformed{scene::Scale{{1, 1, 2}}, turned}, {6, 2});
    EXPECT_NE(error_of(egg, at).find("same factor in every direction"), std::string::npos);
    EXPECT_EQ(at.line, 6U) << "where it is stretched";
    EXPECT_EQ(error_of(solid(scene::Transformed{scene::Rotate{{1, 0, 0}, -30},
                                                solid(scene::Transformed{scene::Scale{{2, 2, 2}}, turned})}),
                       at),
              "");
    const SolidPtr empty = scene::make_solid(scene::FreeQuadric{{1, 1, 1, 0, 0, 0, 0, 0, 0, 1}}, {5, 2});
    EXPECT_NE(error_of(empty, at).find("boundary"), std::string::npos);
    EXPECT_EQ(at.line, 5U);
    const SolidPtr nothing = scene::make_solid(scene::Cuboid{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, 0}}, {4, 2});
    EXPECT_NE(error_of(nothing, at).find("boundary"), std::string::npos);
    EXPECT_EQ(at.line, 4U);
}

} // namespace
} // namespace clucida::test
