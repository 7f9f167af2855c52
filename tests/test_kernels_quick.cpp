// The quick search may only say what the full one would have said.
#include "host/scene_source.h"
#include "kernels/native_api.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace clucida {
namespace {

using Render = decltype(native_render_f);

struct Image {
    std::vector<float> rgba;
    std::vector<u32> stats;
};

Image rendered(const scene::Compiled& compiled, const scene::View& view, Render* render)
{
    NativeScene native{};
    for (std::size_t i = 0; i < BUFFER_COUNT; i++) native.buffers[i] = compiled.buffers.bytes[i].data();
    Image image{std::vector<float>(std::size_t{4} * view.width * view.height), std::vector<u32>(STAT_COUNT)};
    render(&native, 0, 0, view.width, view.height, 0, 1, image.rgba.data(), image.stats.data());
    return image;
}

TEST(QuickSearch, ChangesNoByteOfAnyShippedScene)
{
    u32 queries = 0, full = 0;
    std::size_t scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CLUCIDA_SCENES)) {
        if (entry.path().extension() != ".clu") continue;
        const host::SceneSource source = host::load_scene({entry.path().string(), "", "", false});
        const scene::View view{96, 54, 1, {}, {}, {}};
        const scene::Compiled compiled = host::compile_scene(source, view);
        const Image quick = rendered(compiled, view, native_render_f),
                    whole = rendered(compiled, view, native_render_full);
        EXPECT_EQ(quick.rgba, whole.rgba) << entry.path();
        EXPECT_EQ(quick.stats[STAT_RAYS], whole.stats[STAT_RAYS]) << entry.path();
        EXPECT_EQ(quick.stats[STAT_PARITY], 0U) << entry.path();
        queries += quick.stats[STAT_RAYS] + quick.stats[STAT_SHADOW];
        full += quick.stats[STAT_FULL];
        scenes++;
    }
    EXPECT_GE(scenes, 19U);
    EXPECT_LT(full, queries / 4) << "the full search is for the few";
}

} // namespace
} // namespace clucida
