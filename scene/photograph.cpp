#include "scene/photograph.h"

#include "scene/error.h"
#include "scene/limits.h"
#include "scene/picture_check.h"
#include "scene/pnm.h"

#include <climits>
#include <fmt/format.h>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <stb/stb_image.h>

namespace clucida::scene {
namespace {

struct FreeImage {
    void operator()(stbi_uc* image) const { stbi_image_free(image); }
};

/// The whole file, or nothing if it cannot be read.
std::optional<std::string> bytes_of(const std::string& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream bytes;
    if (!in || (in.peek() != std::ifstream::traits_type::eof() && !(bytes << in.rdbuf()))) return {};
    return std::move(bytes).str();
}

std::uint32_t packed(std::uint32_t r, std::uint32_t g, std::uint32_t b)
{
    return r | g << 8U | b << 16U;
}

Texels from_pnm(const Pnm& pnm)
{
    Texels texels{pnm.width, pnm.height, {}};
    texels.rgb.reserve(pnm.samples.size() / 3);
    const auto byte = [&](std::size_t i) { return (pnm.samples[i] * 255U + pnm.most / 2) / pnm.most; };
    for (std::size_t i = 0; i < pnm.samples.size(); i += 3)
        texels.rgb.push_back(packed(byte(i), byte(i + 1), byte(i + 2)));
    return texels;
}

Texels from_stb(const stbi_uc* image, int width, int height)
{
    Texels texels{static_cast<unsigned>(width), static_cast<unsigned>(height), {}};
    const std::size_t count = std::size_t{texels.width} * texels.height;
    texels.rgb.resize(count);
    for (std::size_t i = 0; i < count; ++i) texels.rgb[i] = packed(image[3 * i], image[3 * i + 1], image[3 * i + 2]);
    return texels;
}

} // namespace

Texels load_photograph(const Photograph& photograph)
{
    const std::string& name = photograph.path;
    const auto fail = [&](const std::string& why) { throw Error(photograph.at, why); };
    const auto fail_unreadable = [&](const std::string& why) {
        fail(fmt::format("'{}' is no photograph that can be read: {}", name, why));
    };
    const auto check_size = [&](auto width, auto height) {
        const decltype(width) side = limits::photograph_side;
        if (width >= 1 && height >= 1 && width <= side && height <= side) return;
        fail(fmt::format("the photograph '{}' has {} x {} pixels; expected {} at most on a side", name, width, height,
                         side));
    };

    const std::optional<std::string> bytes = bytes_of(photograph.file);
    if (!bytes) fail(fmt::format("the photograph '{}' cannot be opened", name));
    if (is_pnm(*bytes)) {
        const Pnm pnm = read_pnm(*bytes);
        if (!pnm.fault.empty()) fail_unreadable(pnm.fault);
        check_size(pnm.width, pnm.height);
        return from_pnm(pnm);
    }
    if (bytes->size() > INT_MAX) fail_unreadable("the file is too large");
    if (const std::string fault = picture_fault(*bytes); !fault.empty()) fail_unreadable(fault);
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes->data());
    const int size = static_cast<int>(bytes->size());
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) fail_unreadable(stbi_failure_reason());
    check_size(width, height);
    const std::unique_ptr<stbi_uc, FreeImage> image(stbi_load_from_memory(data, size, &width, &height, &channels, 3));
    if (image == nullptr) fail_unreadable(stbi_failure_reason());
    return from_stb(image.get(), width, height);
}

std::shared_ptr<const Texels> PhotographCache::load(const Photograph& photograph)
{
    const std::lock_guard lock(mutex_); // while it is read, too: others are likely to want the same
    auto& texels = known_[photograph.file];
    if (!texels) texels = std::make_shared<const Texels>(load_photograph(photograph));
    return texels;
}

} // namespace clucida::scene
