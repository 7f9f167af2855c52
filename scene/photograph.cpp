#include "scene/photograph.h"

#include "scene/error.h"
#include "scene/limits.h"

#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <stb/stb_image.h>

namespace clucida::scene {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
struct FreeImage {
    void operator()(stbi_uc* image) const { stbi_image_free(image); }
};

} // namespace

Texels load_photograph(const Photograph& photograph)
{
    const auto fail = [&](const std::string& why) { throw Error(photograph.at, why); };
    const std::string& name = photograph.path;
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(photograph.file.c_str(), "rb"));
    if (file == nullptr) fail(fmt::format("the photograph '{}' cannot be opened", name));
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_file(file.get(), &width, &height, &channels) == 0) {
        fail(fmt::format("'{}' is no photograph that can be read: {}", name, stbi_failure_reason()));
    }
    const auto side = static_cast<int>(limits::photograph_side);
    if (width < 1 || height < 1 || width > side || height > side) {
        fail(fmt::format("the photograph '{}' has {} x {} pixels; expected {} at most on a side", name, width, height,
                         side));
    }
    const std::unique_ptr<stbi_uc, FreeImage> image(stbi_load_from_file(file.get(), &width, &height, &channels, 3));
    if (image == nullptr) {
        fail(fmt::format("'{}' is no photograph that can be read: {}", name, stbi_failure_reason()));
    }
    Texels texels{static_cast<unsigned>(width), static_cast<unsigned>(height), {}};
    const std::size_t count = static_cast<std::size_t>(texels.width) * texels.height;
    texels.rgb.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const stbi_uc* texel = image.get() + 3 * i;
        texels.rgb.push_back(texel[0] | std::uint32_t{texel[1]} << 8U | std::uint32_t{texel[2]} << 16U);
    }
    return texels;
}

} // namespace clucida::scene
