#include "bench/kernel_error.h"

#include "host/compare.h"
#include "host/errors.h"
#include "host/share_work.h"
#include "host/signatures.h"
#include "scene/linear.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clucida::bench {
namespace {

using Real = long double;
using Vector = std::array<Real, 3>;

constexpr unsigned columns = 96, rows = 54, steps = 6;
constexpr double unit = 0x1p-24;

/// A ray of the kernels, and what it met.
struct Record {
    std::array<double, 3> o{}, d{}, p{};
    u32 found = 0, object = 0, face = 0; ///< found: 0 not traced, 1 nothing met, 2 met
};

std::vector<host::Pixel> grid(const host::Shape& picture)
{
    const unsigned w = std::min<unsigned>(columns, static_cast<unsigned>(picture.width));
    const unsigned h = std::min<unsigned>(rows, static_cast<unsigned>(picture.height));
    std::vector<host::Pixel> out;
    for (unsigned j = 0; j < h; j++)
        for (unsigned i = 0; i < w; i++)
            out.push_back({static_cast<unsigned>(std::size_t{i} * picture.width / w),
                           static_cast<unsigned>(std::size_t{j} * picture.height / h)});
    return out;
}

template <typename T>
std::vector<Record> launch(host::Renderer& renderer, cl::Kernel& kernel, std::vector<host::Pixel> pixels)
{
    const std::size_t records = pixels.size() * steps;
    std::vector<T> numbers(9 * records);
    std::vector<u32> marks(3 * records);
    const cl::Context& context = renderer.context;
    const auto bytes = [](const auto& v) { return v.size() * sizeof(v[0]); };
    const cl::Buffer pixel_buffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, bytes(pixels), pixels.data());
    const cl::Buffer number_buffer(context, CL_MEM_READ_WRITE, bytes(numbers));
    const cl::Buffer mark_buffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, bytes(marks), marks.data());
    cl_uint argument = BUFFER_COUNT;
    kernel.setArg(argument++, pixel_buffer);
    kernel.setArg(argument++, static_cast<cl_uint>(pixels.size()));
    kernel.setArg(argument++, cl_uint{steps});
    kernel.setArg(argument++, number_buffer);
    kernel.setArg(argument, mark_buffer);
    host::enqueue_each(renderer, kernel, pixels.size());
    renderer.queue.enqueueReadBuffer(number_buffer, CL_TRUE, 0, bytes(numbers), numbers.data());
    renderer.queue.enqueueReadBuffer(mark_buffer, CL_TRUE, 0, bytes(marks), marks.data());

    std::vector<Record> out(records);
    for (std::size_t i = 0; i < records; i++) {
        for (std::size_t k = 0; k < 3; k++) {
            out[i].o[k] = numbers[9 * i + k];
            out[i].d[k] = numbers[9 * i + 3 + k];
            out[i].p[k] = numbers[9 * i + 6 + k];
        }
        out[i].found = marks[3 * i];
        out[i].object = marks[3 * i + 1];
        out[i].face = marks[3 * i + 2];
    }
    return out;
}

std::vector<Record> trace_records(host::Renderer& renderer, const scene::Compiled& compiled, const scene::Needs& needs,
                                  const host::RenderSettings& settings)
{
    try {
        const host::Program program = host::build_program(
            renderer.context, renderer.device, host::resolve_includes("kernels/intersect.cl", settings.kernels),
            host::variant_options(needs, settings.precision, renderer.device.info), settings.cache);
        cl::Kernel kernel(program.handle, "intersect");
        const host::DeviceBuffers buffers = host::upload(renderer, compiled.buffers);
        for (cl_uint i = 0; i < BUFFER_COUNT; ++i) kernel.setArg(i, buffers[i]);
        const std::vector<host::Pixel> pixels = grid(settings.picture);
        return settings.precision == host::Precision::twofold ? launch<cl_double>(renderer, kernel, pixels)
                                                              : launch<cl_float>(renderer, kernel, pixels);
    } catch (const cl::Error& e) {
        throw host::Failure(fmt::format("{}: {}", describe(renderer.device.info), host::explain(e)));
    }
}

/// The judge of one pixel's records.
struct Judge {
    const oracle::World<Real>& world;
    const scene::Compiled& compiled;
    const FaceNames& names;
    std::vector<double> errors{};
    std::size_t wrong = 0;

    double grain(u32 object) const
    {
        return reinterpret_cast<const LayoutObject*>(compiled.buffers.bytes[BUFFER_OBJECTS].data())[object].grain;
    }

    void add(std::span<const Record> records)
    {
        const Vector eye{world.observer.eye.x, world.observer.eye.y, world.observer.eye.z};
        std::vector<oracle::Surface> left;
        for (const Record& r : records) {
            if (r.found == 0) return;
            const Vector o{eye[0] + r.o[0], eye[1] + r.o[1], eye[2] + r.o[2]}, d{r.d[0], r.d[1], r.d[2]};
            const auto hit = oracle::next<Real>(world, o, d, left);
            if (hit.has_value() != (r.found == 2) || (hit && !same_surface(r, *hit))) {
                wrong++;
                errors.push_back(HUGE_VAL);
                return;
            }
            if (!hit) {
                errors.push_back(0);
                return;
            }
            errors.push_back(error_of(r, *hit, eye));
            left = hit->surfaces;
        }
    }

    bool same_surface(const Record& r, const oracle::Hit<Real>& hit) const
    {
        if (r.object != hit.object || r.face == MEMBER_NONE) return false;
        const FaceNames::OfObject& faces = names.objects.at(r.object);
        return faces.of_kernel.at(r.face) == faces.of_oracle.at(hit.face);
    }

    double error_of(const Record& r, const oracle::Hit<Real>& hit, const Vector& eye) const
    {
        const Vector at{hit.point.x, hit.point.y, hit.point.z}, n{hit.normal.x, hit.normal.y, hit.normal.z};
        Real off = 0, cosine = 0, dd = 0, size = grain(r.object);
        for (std::size_t k = 0; k < 3; k++) {
            const Real e = r.p[k] - (at[k] - eye[k]);
            off += e * e;
            cosine += n[k] * r.d[k];
            dd += Real(r.d[k]) * r.d[k];
            size = std::max({size, std::fabs(Real(r.o[k])), std::fabs(at[k] - eye[k])});
        }
        return static_cast<double>(std::sqrt(off) * std::fabs(cosine) / std::sqrt(dd) / (size * unit));
    }
};

} // namespace

KernelError measure_kernel_error(host::Renderer& renderer, const scene::Scene& scene, const scene::Compiled& compiled,
                                 const scene::Needs& needs, const host::RenderSettings& settings,
                                 const FaceNames& names, unsigned threads)
{
    const std::vector<Record> records = trace_records(renderer, compiled, needs, settings);
    const auto world = oracle::build<Real>(scene, {});
    std::vector<Judge> judges(threads, Judge{world, compiled, names});
    host::share_work(records.size() / steps, threads, [&](std::size_t i, unsigned worker) {
        judges[worker].add(std::span(records).subspan(i * steps, steps));
    });

    KernelError out;
    std::vector<double> errors;
    for (const Judge& judge : judges) {
        out.wrong += judge.wrong;
        errors.insert(errors.end(), judge.errors.begin(), judge.errors.end());
    }
    out.rays = errors.size();
    std::erase(errors, HUGE_VAL);
    if (errors.empty()) return out;
    out.p50 = host::percentile(errors, 0.5);
    out.p999 = host::percentile(errors, 0.999);
    out.worst = *std::max_element(errors.begin(), errors.end());
    return out;
}

} // namespace clucida::bench
