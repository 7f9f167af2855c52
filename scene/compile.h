/// The scene compiler: a Scene and a view of it become flat buffers, laid out by kernels/layout.h, and the needs that
/// select the kernel variant.
#pragma once

#include "kernels/layout.h"
#include "scene/model.h"
#include "scene/needs.h"
#include "scene/photograph.h"

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace clucida::scene {

/// Which original program's behaviour to imitate (docs/original.md).
enum class AsOriginal { none, gun, rayt };

/// One of two eyes that look at the same screen: the picture's window, `screen` away from between them. Off-axis: the
/// eyes look in parallel, and what is at the screen's distance lies at the same place in both pictures.
struct Eye {
    double right = 0;  ///< how far the eye is moved to the right, units of the scene
    double screen = 1; ///< units of the scene, above 0
};

/// How the scene is looked at. max_hops and cutoff replace the scene's own when set.
struct View {
    unsigned width = 640, height = 360;
    unsigned samples = 1;
    std::optional<unsigned> max_hops; ///< 1..1000000
    std::optional<double> cutoff;     ///< 0..1
    AsOriginal as_original = AsOriginal::none;
    std::optional<Eye> eye = {}; ///< of a stereo pair
};

/// What a vector held, as bytes and without a copy: a million objects are some hundred MiB.
class Bytes {
public:
    Bytes() = default;
    template <typename T>
    explicit Bytes(std::vector<T>&& items)
    {
        auto kept = std::make_shared<const std::vector<T>>(std::move(items));
        bytes_ = std::as_bytes(std::span(*kept));
        owner_ = std::move(kept);
    }
    const std::byte* data() const { return bytes_.data(); }
    std::size_t size() const { return bytes_.size(); }
    bool empty() const { return bytes_.empty(); }

private:
    std::shared_ptr<const void> owner_;
    std::span<const std::byte> bytes_;
};

struct Buffers {
    std::array<Bytes, BUFFER_COUNT> bytes; ///< in the order of LayoutBuffer; some may be empty
};

struct Compiled {
    Buffers buffers;
    Needs needs;
    std::size_t interior_bound =
        0; ///< the most objects that may hold one point; needs.interior may be less to begin with
};

std::size_t byte_count(const Buffers& buffers);
std::size_t object_count(const Buffers& buffers);

/// Where the observer's eye is: the origin of the buffers' coordinates, unless the view has an eye of its own.
Vec3 eye_of(const Scene& scene);

/// From the observer's eye to the point that it looks at: a stereo pair's screen, unless something else is said.
double view_distance(const Scene& scene);

/// @throws Error (scene/error.h) naming the statement, for what a scene's text could not show to be wrong:
/// a solid too large when expanded, a transform that flattens, a photograph that cannot be read.
/// photographs keeps what was read from frame to frame; or nullptr.
Compiled compile(const Scene& scene, const View& view, PhotographCache* photographs = nullptr);

} // namespace clucida::scene
