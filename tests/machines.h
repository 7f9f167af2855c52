/// The machines that the core runs on: natively as C, and through OpenCL on the device that the program chooses, each
/// in float and in double.
#pragma once

#include "kernels/native_api.h"
#include "scene/compile.h"
#include "scene/linear.h"
#include "scene/model.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace clucida::test {

using scene::Rgb;
using scene::Vec3;

__extension__ using Quad = __float128;
inline constexpr u32 vacuum = 0xffffffffU;
using Stats = std::array<u32, STAT_COUNT>;

struct DeviceScene; ///< a scene's buffers on the device

/// A compiled scene, ready for any machine.
struct Native {
    scene::Compiled compiled;
    NativeScene buffers{};
    mutable std::shared_ptr<DeviceScene> on_device; ///< from the first use on a device on
    explicit Native(const scene::Scene& scene, const scene::View& view = {});
    template <typename T>
    std::span<const T> items(LayoutBuffer buffer) const
    {
        const auto& bytes = compiled.buffers.bytes[buffer];
        return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
    }
};

struct Hit {
    double t = 0;
    Vec3 p, n;
    u32 object = vacuum, before = vacuum, after = vacuum;
    u32 left = MEMBER_NONE;
    bool beyond_inside = false;
    double err = 0; ///< how far p may lie from the boundaries crossed there
};

struct Path {
    Vec3 o, d;
    u32 left = MEMBER_NONE;
    bool left_inside = false;
    double err = 0; ///< of the surface that it leaves
};

/// The next surface is asked for, of a path whose start lies in the given objects (ascending ids).
struct Query {
    Path path;
    std::vector<u32> inside{};
};
using Hits = std::vector<std::optional<Hit>>;

/// Where a ray of direction d goes at the unit normal n on the side that it comes from; w = n1/n2.
struct Bend {
    bool passes = false; ///< else total reflection, and the next two mean nothing
    Vec3 refracted;
    double reflectance = 0;
    Vec3 reflected;
};

/// What all machines do, natively. Stats are added to; render's sums of r, g, b, 0 of all samples go to rgba, row by
/// row.
template <typename Real>
struct NativeCore {
    using real = Real;
    static Hits surfaces(const Native& scene, std::span<const Query> queries, Stats& stats);
    static std::vector<Rgb> traces(const Native& scene, std::span<const Path> paths, Stats& stats);
    static void render(const Native& scene, const scene::View& view, float* rgba, Stats& stats);
    static Bend bend(Vec3 d, Vec3 n, double w);
    static double diffuse(u32 law, double cosine, double distance);
    static Rgb unpack_filter(u32 packed);
    /// A test whose rays go one by one sends one in so many.
    static constexpr int share = 1;
    /// Roundings that a pixel may differ by with what the rest of the picture shows: light is added up in another
    /// order.
    static constexpr double sum_roundings = 0;
};

/// The same with surfaces and pictures by packets of eight rays.
template <typename Real>
struct PacketCore : NativeCore<Real> {
    static Hits surfaces(const Native& scene, std::span<const Query> queries, Stats& stats);
    static void render(const Native& scene, const scene::View& view, float* rgba, Stats& stats);
    static constexpr double sum_roundings = 16;
};

/// The same through OpenCL: one launch a call. They throw where there is no device, or it cannot do double.
template <typename Real>
struct DeviceCore {
    using real = Real;
    static Hits surfaces(const Native& scene, std::span<const Query> queries, Stats& stats);
    static std::vector<Rgb> traces(const Native& scene, std::span<const Path> paths, Stats& stats);
    static void render(const Native& scene, const scene::View& view, float* rgba, Stats& stats);
    static Bend bend(Vec3 d, Vec3 n, double w);
    static double diffuse(u32 law, double cosine, double distance);
    static Rgb unpack_filter(u32 packed);
    static constexpr double sum_roundings = 0;
    static constexpr int share = 8; ///< a launch costs some tens of microseconds
};

/// u is the unit roundoff, Wide a type that is exact beside it.
struct Float : NativeCore<float> {
    using Wide = long double;
    static constexpr double u = 0x1p-24;
    static constexpr const char* name = "Float";
};
struct Double : NativeCore<double> {
    using Wide = Quad;
    static constexpr double u = 0x1p-53;
    static constexpr const char* name = "Double";
};
struct FloatInPackets : PacketCore<float> {
    using Wide = long double;
    static constexpr double u = Float::u;
    static constexpr const char* name = "FloatInPackets";
};
struct DoubleInPackets : PacketCore<double> {
    using Wide = Quad;
    static constexpr double u = Double::u;
    static constexpr const char* name = "DoubleInPackets";
};
struct FloatOnDevice : DeviceCore<float> {
    using Wide = long double;
    static constexpr double u = Float::u;
    static constexpr const char* name = "FloatOnDevice";
};
struct DoubleOnDevice : DeviceCore<double> {
    using Wide = Quad;
    static constexpr double u = Double::u;
    static constexpr const char* name = "DoubleOnDevice";
};

} // namespace clucida::test
