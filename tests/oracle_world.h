/// What the oracle's tests share: its real types, and worlds from a few lines of text. No part of the kernels.
#pragma once

#include "bench/oracle/oracle.h"
#include "scene/read.h"

#include <gtest/gtest.h>
#include <random>
#include <string>

namespace clucida::oracle {

/// u: what an honest result of a few operations may be off by, relative to its size. Colours are told in double.
struct InDouble {
    using Real = double;
    static constexpr double u = 0x1p-53;
    static constexpr const char* name = "Double";
};
struct InLongDouble {
    using Real = long double;
    static constexpr double u = 0x1p-64;
    static constexpr const char* name = "LongDouble";
};
struct InQuad {
    using Real = Quad;
    static constexpr double u = 0x1p-113;
    static constexpr const char* name = "Quad";
};
struct InBig {
    using Real = Big;
    static constexpr double u = 0x1p-166;
    static constexpr const char* name = "Big";
};
using Types = ::testing::Types<InDouble, InLongDouble, InQuad, InBig>;
struct TypeNames {
    template <typename T>
    static std::string GetName(int)
    {
        return T::name;
    }
};

/// Of results of size 1: so many roundings of the type's own, and a few of double, in which colours are told.
template <typename T>
double roundings(double many)
{
    return many * T::u + 0x1p-50;
}

/// Statements of clucida's own language.
inline scene::Scene read(const std::string& statements)
{
    std::string text = "clucida 1\n";
    if (statements.find("observer") == std::string::npos) text += "observer { eye [0,0,0]; look [0,1,0] }\n";
    return scene::read_scene(text + statements, "test", scene::Format::clucida, ".");
}

inline scene::Scene shipped(const std::string& name)
{
    return scene::read_scene_file(std::string(CLUCIDA_SCENES) + "/" + name);
}

/// No cutoff; of hops as many as are asked for.
inline Options free_options(unsigned hops = 19)
{
    Options options;
    options.view.max_hops = hops;
    options.view.cutoff = 0;
    return options;
}

template <typename T>
World<typename T::Real> world_of(const std::string& statements, const Options& options = free_options())
{
    return build<typename T::Real>(read(statements), options);
}

template <typename Real>
using Three = std::array<Real, 3>;

/// What `sky rgb` shows, read back as the direction that it stands for.
inline Vec<double> direction_of(const Three<double>& sky)
{
    return {2 * sky[0] - 1, 2 * sky[1] - 1, 1 - 2 * sky[2]};
}

/// All surfaces on the straight line from o along d, those behind each other.
template <typename Real>
std::vector<Hit<Real>> surfaces_along(const World<Real>& world, Three<Real> o, const Three<Real>& d)
{
    std::vector<Hit<Real>> found;
    Real t = 0;
    std::vector<Surface> left;
    while (auto hit = next<Real>(world, o, d, left)) {
        t += hit->t;
        o = {hit->point.x, hit->point.y, hit->point.z};
        left = hit->surfaces;
        hit->t = t;
        found.push_back(*hit);
        if (found.size() > 100) break;
    }
    return found;
}

/// Every pixel of a picture, its first sample.
inline std::vector<Pixel> all_pixels(const scene::View& view)
{
    std::vector<Pixel> pixels;
    for (unsigned y = 0; y < view.height; y++)
        for (unsigned x = 0; x < view.width; x++) pixels.push_back({x, y, 0});
    return pixels;
}

inline double farthest(const Three<double>& a, const Three<double>& b)
{
    double most = 0;
    for (std::size_t i = 0; i < 3; i++) most = std::max(most, std::fabs(a[i] - b[i]));
    return most;
}

using Random = std::mt19937_64;
inline double uniform(Random& random, double low, double high)
{
    return low + (high - low) * (static_cast<double>(random() >> 11U) * 0x1p-53);
}

} // namespace clucida::oracle
