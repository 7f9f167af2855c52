#include "scene/compile_optics.h"

#include "scene/error.h"
#include "scene/pack.h"
#include "scene/store.h"

#include <bit>
#include <map>

namespace clucida::scene {
namespace {

/// Extinction per unit of length; a filter of 0 is opaque at any distance that matters.
float extinction(double transmittance)
{
    if (transmittance >= 1) return 0;
    return transmittance <= 0 ? 1e30F : static_cast<float>(-std::log(transmittance));
}

/// The original program (rayt) ranks media by how much they let through.
float rank(const Optics& o)
{
    const auto channel = [](double refraction, double passthrough) {
        return srgb_decode(rounded_to_byte(refraction)) + srgb_decode(rounded_to_byte(passthrough));
    };
    return static_cast<float>(channel(o.refraction.r, o.passthrough.r) + channel(o.refraction.g, o.passthrough.g) +
                              channel(o.refraction.b, o.passthrough.b));
}

LayoutOptics layout(const Optics& o)
{
    LayoutOptics l{};
    l.reflection = pack_filter(o.reflection);
    l.absorption = pack_filter(o.absorption);
    l.refraction = pack_filter(o.refraction);
    l.index = static_cast<float>(o.index);
    l.extinction[0] = extinction(o.passthrough.r);
    l.extinction[1] = extinction(o.passthrough.g);
    l.extinction[2] = extinction(o.passthrough.b);
    l.flags = o.fresnel && o.index > 0 ? OPTICS_FRESNEL : 0;
    l.rank = rank(o);
    return l;
}

std::uint32_t features_of(const Optics& o)
{
    std::uint32_t features = 0;
    if (o.index > 0) features |= feature_transparent;
    if (o.index < 0) features |= feature_emission;
    if (o.index != 0 && o.passthrough != Rgb{1, 1, 1}) features |= feature_extinction;
    if (o.index > 0 && o.fresnel) features |= feature_fresnel;
    return features;
}

/// Photographs that several textures use are stored once.
class Images {
public:
    Images(OpticsBuffers& buffers, PhotographCache& photographs) : out(buffers), cache(photographs) {}

    u32 add(const Photograph& photograph)
    {
        const u32 flags = (photograph.linear ? IMAGE_LINEAR : 0) | (photograph.interpolate ? IMAGE_INTERPOLATE : 0);
        const auto key = std::pair{photograph.file, flags};
        if (const auto found = known.find(key); found != known.end()) return found->second;
        if (out.texels.empty()) add_decoding_table();
        const std::shared_ptr<const Texels> texels = cache.load(photograph);
        const std::size_t offset = out.texels.size();
        if (offset + texels->rgb.size() > 1u << 29)
            throw Error(photograph.at, "the scene's photographs are too large; expected at most 2^29 pixels in all");
        out.texels.insert(out.texels.end(), texels->rgb.begin(), texels->rgb.end());
        out.images.push_back({static_cast<u32>(offset), texels->width, texels->height, flags});
        return known[key] = static_cast<u32>(out.images.size() - 1);
    }

private:
    void add_decoding_table()
    {
        for (int i = 0; i < 256; i++)
            out.texels.push_back(std::bit_cast<u32>(static_cast<float>(srgb_decode(i / 255.0))));
    }

    OpticsBuffers& out;
    PhotographCache& cache;
    std::map<std::pair<std::string, u32>, u32> known;
};

/// The frame of a mapping's axis n with angles theta, phi (phi = 0 on the z axis), as docs/scene-language.md has it.
void set_frame(LayoutTexture& t, Vec3 n)
{
    const double size = length(n);
    const double across = std::hypot(n.x, n.y);
    const double cos_theta = n.z / size, sin_theta = across / size;
    const double cos_phi = across > 0 ? n.x / across : 1, sin_phi = across > 0 ? n.y / across : 0;
    store(t.x, Vec3{cos_theta * cos_phi, cos_theta * sin_phi, -sin_theta});
    store(t.y, Vec3{-sin_phi, cos_phi, 0});
    store(t.z, n * (1 / size));
    t.scale = static_cast<float>(1 / size);
}

void set_mapping(LayoutTexture& t, const Directional& m, Vec3)
{
    t.mapping = MAPPING_DIRECTIONAL;
    set_frame(t, m.n);
}

void set_mapping(LayoutTexture& t, const Positional& m, Vec3 eye)
{
    t.mapping = MAPPING_POSITIONAL;
    set_frame(t, m.n);
    // The eye's own phase, so that positions relative to it serve.
    const auto phase = [&](const float* axis) {
        const double at = (axis[0] * eye.x + axis[1] * eye.y + axis[2] * eye.z) * t.scale;
        return static_cast<float>(at - std::floor(at));
    };
    t.origin[0] = phase(t.x);
    t.origin[1] = phase(t.y);
}

void set_mapping(LayoutTexture& t, const Relative& m, Vec3 eye)
{
    t.mapping = MAPPING_RELATIVE;
    set_frame(t, m.n);
    store(t.origin, m.origin - eye);
}

void set_mapping(LayoutTexture& t, const Linear& m, Vec3 eye)
{
    t.mapping = MAPPING_LINEAR;
    set_frame(t, m.n);
    store(t.origin, m.origin - eye);
}

void set_mapping(LayoutTexture& t, const Planar& m, Vec3 eye)
{
    t.mapping = MAPPING_PLANAR;
    store(t.x, m.u * (1 / dot(m.u, m.u)));
    store(t.y, m.v * (1 / dot(m.v, m.v)));
    store(t.origin, m.origin - eye);
    t.scale = 1;
}

LayoutTexture layout(const Texture& texture, Vec3 eye, Images& images)
{
    LayoutTexture t{};
    t.image = images.add(texture.photograph);
    std::visit([&](const auto& mapping) { set_mapping(t, mapping, eye); }, texture.mapping);
    t.wrap[0] = static_cast<float>(texture.wrap_x);
    t.wrap[1] = static_cast<float>(texture.wrap_y);
    t.reflection = pack_filter(texture.reflection);
    t.absorption = pack_filter(texture.absorption);
    t.refraction = pack_filter(texture.refraction);
    return t;
}

std::uint32_t set_sky(LayoutFrame& frame, const SkyColor& sky, Images&)
{
    frame.sky = SKY_COLOR;
    store(frame.sky_low, sky.color);
    return 0;
}

std::uint32_t set_sky(LayoutFrame& frame, const SkyGradient& sky, Images&)
{
    frame.sky = SKY_GRADIENT;
    store(frame.sky_axis, unit(sky.up));
    store(frame.sky_low, sky.low);
    store(frame.sky_middle, sky.middle);
    store(frame.sky_high, sky.high);
    return feature_sky_gradient;
}

std::uint32_t set_sky(LayoutFrame& frame, const SkyRgb&, Images&)
{
    frame.sky = SKY_RGB;
    return feature_sky_rgb;
}

std::uint32_t set_sky(LayoutFrame& frame, const SkyHsv&, Images&)
{
    frame.sky = SKY_HSV;
    return feature_sky_hsv;
}

std::uint32_t set_sky(LayoutFrame& frame, const SkyPhotograph& sky, Images& images)
{
    frame.sky = SKY_PHOTOGRAPH;
    frame.sky_image = images.add(sky.photograph);
    return feature_sky_photograph;
}

std::uint32_t light_feature(LightLaw law)
{
    switch (law) {
    case LightLaw::paper: return feature_light_paper;
    case LightLaw::lambert: return feature_light_lambert;
    case LightLaw::inverse_square: return feature_light_inverse_square;
    }
    return 0;
}

} // namespace

OpticsBuffers compile_optics(const Scene& scene, Vec3 eye, LayoutFrame& frame, PhotographCache& photographs)
{
    OpticsBuffers out;
    Images images(out, photographs);
    for (const Optics& optics : scene.optics) out.optics.push_back(layout(optics));
    for (const Object& object : scene.objects) {
        out.features |= features_of(scene.optics[object.optics]);
        if (object.texture) out.features |= feature_texture;
    }
    for (const Texture& texture : scene.textures) out.textures.push_back(layout(texture, eye, images));
    for (const Light& light : scene.lights) {
        LayoutLight l{};
        store(l.point, light.point - eye);
        store(l.color, light.color);
        out.lights.push_back(l);
    }
    if (!scene.lights.empty()) out.features |= light_feature(scene.settings.light_law);
    if (scene.settings.media_rule == MediaRule::rank) out.features |= feature_media_rank;
    out.features |= std::visit([&](const auto& sky) { return set_sky(frame, sky, images); }, scene.sky);
    return out;
}

} // namespace clucida::scene
