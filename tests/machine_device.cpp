// The core through OpenCL, on the device that the program chooses by default (CLUCIDA_DEVICE selects another).
#include "host/devices.h"
#include "host/errors.h"
#include "host/kernel_source.h"
#include "host/program.h"
#include "host/renderer.h"
#include "machines.h"

#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

namespace clucida::test {

struct DeviceScene {
    std::array<cl::Buffer, BUFFER_COUNT> buffers;
};

namespace {

/// One build with every feature of clucida's own language serves all scenes.
scene::Needs all_features()
{
    scene::Needs needs;
    for (const scene::FeatureName& f : scene::feature_names())
        if (f.feature != scene::feature_as_gun && f.feature != scene::feature_as_rayt) needs.features |= f.feature;
    needs.interior = needs.stack = needs.groups = 64;
    needs.walk = 256;
    return needs;
}

std::string probe_source()
{
    std::ifstream file(CLUCIDA_TEST_PROBE);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (text.empty()) throw std::runtime_error("tests/probe.cl cannot be read");
    return host::resolve_includes("tests/probe.cl", [&](const std::string& path) -> std::optional<std::string_view> {
        if (path == "tests/probe.cl") return text;
        return host::embedded_kernel(path);
    });
}

/// A device with the program in one precision; its kernels by name.
struct Machine {
    host::Renderer device;
    host::Program program;
    std::map<std::string, cl::Kernel> kernels{};

    explicit Machine(const host::Renderer& renderer, host::Precision precision)
        : device(renderer),
          program(host::build_program(renderer.context, renderer.device, probe_source(),
                                      host::variant_options(all_features(), precision, renderer.device.info),
                                      host::KernelCache::automatic))
    {
    }
    cl::Kernel& kernel(const char* name)
    {
        auto& found = kernels[name];
        if (!found()) found = cl::Kernel(program.handle, name);
        return found;
    }
    /// A buffer with a copy of the values. OpenCL has no empty ones.
    template <typename Values>
    cl::Buffer sent(const Values& values) const
    {
        using T = std::remove_const_t<std::remove_pointer_t<decltype(values.data())>>;
        static const T none[4]{};
        const std::size_t bytes = values.size() * sizeof(T);
        return {device.context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, bytes ? bytes : sizeof none,
                const_cast<T*>(bytes ? values.data() : none)};
    }
    template <typename T>
    void fetch(const cl::Buffer& buffer, std::vector<T>& values) const
    {
        device.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, values.size() * sizeof(T), values.data());
    }
    /// Work-groups of one: PoCL keeps what all items of a group hold on one stack, and this program's hold much.
    void launch(const cl::Kernel& kernel, std::size_t width, std::size_t height = 1) const
    {
        device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(width, height), cl::NDRange(1, 1));
    }
};

const host::Renderer& renderer()
{
    static const host::Renderer one = host::make_renderer(host::find_device(host::device_selector("")));
    return one;
}

template <typename Real>
Machine& machine()
{
    static Machine one(renderer(), sizeof(Real) == sizeof(double) ? host::Precision::twofold : host::Precision::single);
    return one;
}

/// Sets the scene's buffers, uploaded at its first use; the number of the next argument.
cl_uint set_scene(const Machine& m, cl::Kernel& kernel, const Native& scene)
{
    const scene::Needs &needs = scene.compiled.needs, all = all_features();
    if (needs.interior > all.interior || needs.stack > all.stack || needs.groups > all.groups || needs.walk > all.walk)
        throw std::runtime_error("this scene needs more room than the tests' program has on a device");
    if (!scene.on_device) {
        scene.on_device = std::make_shared<DeviceScene>();
        for (std::size_t i = 0; i < BUFFER_COUNT; i++)
            scene.on_device->buffers[i] = m.sent(scene.compiled.buffers.bytes[i]);
    }
    cl_uint argument = 0;
    for (const cl::Buffer& buffer : scene.on_device->buffers) kernel.setArg(argument++, buffer);
    return argument;
}

/// A kernel does not keep its buffers: they must outlive the launch.
void set_arguments(cl::Kernel& kernel, cl_uint argument, std::span<const cl::Buffer> buffers)
{
    for (const cl::Buffer& buffer : buffers) kernel.setArg(argument++, buffer);
}

void add_rows(Stats& stats, const std::vector<u32>& rows)
{
    for (std::size_t i = 0; i < rows.size(); i++) stats[i % STAT_COUNT] += rows[i];
}

template <typename Real>
void push(std::vector<Real>& numbers, Vec3 v)
{
    for (const double x : {v.x, v.y, v.z}) numbers.push_back(static_cast<Real>(x));
}

template <typename Real>
Vec3 vec_at(const std::vector<Real>& numbers, std::size_t i)
{
    return {numbers[i], numbers[i + 1], numbers[i + 2]};
}

/// A launch of one item: its numbers, a plain argument if there is one, and as many answers.
template <typename Real>
std::vector<Real> ask(const char* name, const std::vector<Real>& numbers, std::optional<u32> plain, std::size_t count)
{
    Machine& m = machine<Real>();
    cl::Kernel& kernel = m.kernel(name);
    std::vector<Real> answers(count);
    const cl::Buffer numbers_buffer = m.sent(numbers), answer_buffer = m.sent(answers);
    cl_uint argument = 0;
    if (!numbers.empty()) kernel.setArg(argument++, numbers_buffer);
    if (plain) kernel.setArg(argument++, *plain);
    kernel.setArg(argument, answer_buffer);
    m.launch(kernel, 1);
    m.fetch(answer_buffer, answers);
    return answers;
}

} // namespace

template <typename Real>
Hits DeviceCore<Real>::surfaces(const Native& scene, std::span<const Query> queries, Stats& stats)
{
    if (queries.empty()) return {};
    Machine& m = machine<Real>();
    cl::Kernel& kernel = m.kernel("probe_surface");
    std::vector<Real> numbers;
    std::vector<u32> marks, inside, counters(STAT_COUNT);
    for (const Query& q : queries) {
        push(numbers, q.path.o);
        push(numbers, q.path.d);
        numbers.push_back(static_cast<Real>(q.path.err));
        for (const std::size_t mark :
             {std::size_t{q.path.left}, std::size_t{q.path.left_inside}, inside.size(), q.inside.size()})
            marks.push_back(static_cast<u32>(mark));
        inside.insert(inside.end(), q.inside.begin(), q.inside.end());
    }
    std::vector<Real> answers(8 * queries.size());
    std::vector<u32> found(6 * queries.size());
    const cl::Buffer answer_buffer = m.sent(answers), found_buffer = m.sent(found), stats_buffer = m.sent(counters);
    const std::array buffers{m.sent(numbers), m.sent(marks), m.sent(inside), answer_buffer, found_buffer, stats_buffer};
    set_arguments(kernel, set_scene(m, kernel, scene), buffers);
    m.launch(kernel, queries.size());
    m.fetch(answer_buffer, answers);
    m.fetch(found_buffer, found);
    m.fetch(stats_buffer, counters);
    add_rows(stats, counters);

    Hits hits;
    for (std::size_t i = 0; i < queries.size(); i++) {
        const u32* f = &found[6 * i];
        if (f[0])
            hits.push_back(Hit{answers[8 * i], vec_at(answers, 8 * i + 1), vec_at(answers, 8 * i + 4), f[1], f[2], f[3],
                               f[4], f[5] != 0, answers[8 * i + 7]});
        else
            hits.push_back(std::nullopt);
    }
    return hits;
}

template <typename Real>
std::vector<Rgb> DeviceCore<Real>::traces(const Native& scene, std::span<const Path> paths, Stats& stats)
{
    if (paths.empty()) return {};
    Machine& m = machine<Real>();
    cl::Kernel& kernel = m.kernel("probe_trace");
    std::vector<Real> numbers, answers(3 * paths.size());
    std::vector<u32> marks, counters(STAT_COUNT);
    for (const Path& path : paths) {
        push(numbers, path.o);
        push(numbers, path.d);
        numbers.push_back(static_cast<Real>(path.err));
        for (const u32 mark : {path.left, u32{path.left_inside}, 0U, 0U}) marks.push_back(mark);
    }
    const cl::Buffer answer_buffer = m.sent(answers), stats_buffer = m.sent(counters);
    const std::array buffers{m.sent(numbers), m.sent(marks), answer_buffer, stats_buffer};
    set_arguments(kernel, set_scene(m, kernel, scene), buffers);
    m.launch(kernel, paths.size());
    m.fetch(answer_buffer, answers);
    m.fetch(stats_buffer, counters);
    add_rows(stats, counters);

    std::vector<Rgb> colors;
    for (std::size_t i = 0; i < answers.size(); i += 3) colors.push_back({answers[i], answers[i + 1], answers[i + 2]});
    return colors;
}

template <typename Real>
void DeviceCore<Real>::render(const Native& scene, const scene::View& view, float* rgba, Stats& stats)
{
    Machine& m = machine<Real>();
    cl::Kernel& kernel = m.kernel("render");
    std::vector<float> tile(std::size_t{4} * view.width * view.height);
    std::vector<u32> counters(std::size_t{STAT_SLOTS} * STAT_COUNT);
    const cl::Buffer tile_buffer = m.sent(tile), stats_buffer = m.sent(counters);
    cl_uint argument = set_scene(m, kernel, scene);
    for (const cl_uint number : {0U, 0U, 0U, view.samples}) kernel.setArg(argument++, number);
    kernel.setArg(argument++, tile_buffer);
    kernel.setArg(argument++, stats_buffer);
    m.launch(kernel, view.width, view.height);
    m.fetch(tile_buffer, tile);
    m.fetch(stats_buffer, counters);
    std::ranges::copy(tile, rgba);
    add_rows(stats, counters);
}

template <typename Real>
Bend DeviceCore<Real>::bend(Vec3 d, Vec3 n, double w)
{
    std::vector<Real> numbers;
    push(numbers, d);
    push(numbers, n);
    numbers.push_back(static_cast<Real>(w));
    const std::vector<Real> a = ask("probe_bend", numbers, std::nullopt, 8);
    return {a[0] != 0, vec_at(a, 1), a[4], vec_at(a, 5)};
}

template <typename Real>
double DeviceCore<Real>::diffuse(u32 law, double cosine, double distance)
{
    return ask("probe_diffuse", std::vector<Real>{static_cast<Real>(cosine), static_cast<Real>(distance)}, law, 1)[0];
}

template <typename Real>
Rgb DeviceCore<Real>::unpack_filter(u32 packed)
{
    const std::vector<Real> a = ask("probe_filter", std::vector<Real>{}, packed, 3);
    return {a[0], a[1], a[2]};
}

template struct DeviceCore<float>;
template struct DeviceCore<double>;

} // namespace clucida::test
