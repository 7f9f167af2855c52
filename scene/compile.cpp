#include "scene/compile.h"

#include "scene/compile_objects.h"
#include "scene/compile_optics.h"
#include "scene/error.h"
#include "scene/store.h"

#include <algorithm>

namespace clucida::scene {
namespace {

void set_observer(LayoutFrame& frame, const Pinhole& eye)
{
    const double aspect = static_cast<double>(frame.width) / frame.height;
    const double height = 2 * std::tan(eye.fov * (M_PI / 360));
    const Vec3 forward = unit(eye.look - eye.eye);
    const Vec3 right = unit(cross(forward, eye.up));
    store(frame.forward, forward);
    store(frame.column, right * (height * aspect));
    store(frame.row, cross(forward, right) * height);
}

void set_observer(LayoutFrame& frame, const Window& window)
{
    const double aspect = static_cast<double>(frame.width) / frame.height;
    store(frame.forward, window.view - window.eye);
    store(frame.column, window.column * aspect);
    store(frame.row, window.row);
    frame.window = 1;
}

/// To the right in the picture, of length 1.
Vec3 right_of(const Scene& scene)
{
    if (const auto* o = std::get_if<Pinhole>(&scene.observer)) return unit(cross(o->look - o->eye, o->up));
    return unit(std::get<Window>(scene.observer).column);
}

/// The eye moves, the window that it looks through stays: forward leads to the window's middle, which is as far as
/// forward is long.
void move_eye(LayoutFrame& frame, const Scene& scene, const Eye& eye)
{
    const Vec3 forward{frame.forward[0], frame.forward[1], frame.forward[2]};
    store(frame.forward, forward - right_of(scene) * (eye.right * length(forward) / eye.screen));
}

/// The region that the observer's rays start in: a ball about the eye.
double start_radius(const Scene& scene, const View& view)
{
    const auto* window = std::get_if<Window>(&scene.observer);
    if (window == nullptr) return 0;
    const double aspect = static_cast<double>(view.width) / view.height;
    return 0.5 * (length(window->column) * aspect + length(window->row));
}

LayoutFrame make_frame(const Scene& scene, const View& view)
{
    LayoutFrame frame{};
    frame.width = view.width;
    frame.height = view.height;
    frame.samples = view.samples;
    frame.corner = view.as_original == AsOriginal::gun;
    frame.max_hops = view.max_hops.value_or(scene.settings.max_hops);
    frame.cutoff = static_cast<float>(view.cutoff.value_or(scene.settings.cutoff));
    frame.light_law = static_cast<u32>(scene.settings.light_law);
    frame.media_rule = static_cast<u32>(scene.settings.media_rule);
    std::visit([&](const auto& observer) { set_observer(frame, observer); }, scene.observer);
    if (view.eye) move_eye(frame, scene, *view.eye);
    return frame;
}

unsigned capacity_class(std::size_t least, std::size_t most)
{
    unsigned capacity = 1;
    while (capacity < least && capacity < most) capacity *= 2;
    return capacity;
}

/// Room for the branches that wait: each lies a hop deeper than the one before. Deep stacks are rare (the cutoff
/// prunes), so the class starts small and the host enlarges it on overflow.
unsigned stack_class(std::uint32_t features, unsigned max_hops)
{
    if ((features & feature_transparent) == 0) return 0;
    return capacity_class(std::max(max_hops, 2u) - 1, 32);
}

} // namespace

Vec3 eye_of(const Scene& scene)
{
    return std::visit([](const auto& observer) { return observer.eye; }, scene.observer);
}

double view_distance(const Scene& scene)
{
    if (const auto* o = std::get_if<Pinhole>(&scene.observer)) return length(o->look - o->eye);
    const auto& window = std::get<Window>(scene.observer);
    return length(window.view - window.eye);
}

std::size_t byte_count(const Buffers& buffers)
{
    std::size_t out = 0;
    for (const Bytes& bytes : buffers.bytes) out += bytes.size();
    return out;
}

std::size_t object_count(const Buffers& buffers)
{
    return buffers.bytes[BUFFER_OBJECTS].size() / sizeof(LayoutObject);
}

Compiled compile(const Scene& scene, const View& view, PhotographCache* photographs)
{
    PhotographCache of_this_frame;
    Vec3 eye = eye_of(scene);
    if (view.eye) eye = eye + right_of(scene) * view.eye->right;
    LayoutFrame frame = make_frame(scene, view);
    Compiled compiled;

    ObjectBuffers objects = compile_objects(scene, eye, start_radius(scene, view));
    OpticsBuffers optics = compile_optics(scene, eye, frame, photographs ? *photographs : of_this_frame);
    Tree tree = build_tree(std::move(objects.boxes));
    frame.root_count = static_cast<u32>(tree.roots);
    frame.walk_reserve = static_cast<u32>(tree.reserve);
    frame.object_count = static_cast<u32>(objects.objects.size());
    frame.start_count = static_cast<u32>(objects.starts);
    frame.light_count = static_cast<u32>(optics.lights.size());

    compiled.needs.features = objects.features | optics.features;
    if (view.as_original == AsOriginal::gun) compiled.needs.features |= feature_as_gun;
    if (view.as_original == AsOriginal::rayt) compiled.needs.features |= feature_as_rayt;
    compiled.interior_bound = objects.most_overlapping;
    compiled.needs.interior = capacity_class(objects.most_overlapping, 64);
    compiled.needs.stack = stack_class(compiled.needs.features, frame.max_hops);
    compiled.needs.walk = capacity_class(tree.stack, 1u << 16);
    compiled.needs.groups = capacity_class(objects.most_groups, 1u << 16);

    auto& bytes = compiled.buffers.bytes;
    bytes[BUFFER_FRAME] = Bytes(std::vector{frame});
    bytes[BUFFER_NODES] = Bytes(std::move(tree.nodes));
    bytes[BUFFER_OBJECTS] = Bytes(std::move(objects.objects));
    bytes[BUFFER_GROUPS] = Bytes(std::move(objects.groups));
    bytes[BUFFER_MEMBERS] = Bytes(std::move(objects.members));
    bytes[BUFFER_PROGRAMS] = Bytes(std::move(objects.programs));
    bytes[BUFFER_PLANES] = Bytes(std::move(objects.planes));
    bytes[BUFFER_BLOCKS] = Bytes(std::move(objects.blocks));
    bytes[BUFFER_SPHERES] = Bytes(std::move(objects.spheres));
    bytes[BUFFER_QUADRICS] = Bytes(std::move(objects.quadrics));
    bytes[BUFFER_TORI] = Bytes(std::move(objects.tori));
    bytes[BUFFER_OPTICS] = Bytes(std::move(optics.optics));
    bytes[BUFFER_TEXTURES] = Bytes(std::move(optics.textures));
    bytes[BUFFER_IMAGES] = Bytes(std::move(optics.images));
    bytes[BUFFER_TEXELS] = Bytes(std::move(optics.texels));
    bytes[BUFFER_LIGHTS] = Bytes(std::move(optics.lights));
    return compiled;
}

} // namespace clucida::scene
