#include "bench/truth.h"

#include "host/errors.h"

#include <memory>

namespace clucida::bench {
namespace {

template <typename Real>
Truth truth_in(const scene::Scene& scene, const oracle::Options& options, unsigned threads)
{
    const auto world = std::make_shared<const oracle::World<Real>>(oracle::build<Real>(scene, options));
    return [world, threads](std::span<const oracle::Pixel> pixels) { return oracle::render(*world, pixels, threads); };
}

} // namespace

RealType real_type(const std::string& name)
{
    if (name == "double") return RealType::float64;
    if (name == "long-double") return RealType::long_double;
    if (name == "quad") return RealType::quad;
    if (name == "mpfr") return RealType::mpfr;
    throw host::UsageError("the oracle has no type '" + name + "'; expected double, long-double, quad or mpfr");
}

Truth make_truth(const scene::Scene& scene, const oracle::Options& options, RealType type, unsigned threads)
{
    if (options.view.as_original != scene::AsOriginal::none)
        throw host::UsageError("the oracle knows the optical model only, not what the original programs made of it");
    switch (type) {
    case RealType::float64: return truth_in<double>(scene, options, threads);
    case RealType::long_double: return truth_in<long double>(scene, options, threads);
    case RealType::quad: return truth_in<oracle::Quad>(scene, options, threads);
    case RealType::mpfr: return truth_in<oracle::Big>(scene, options, threads);
    }
    return {};
}

} // namespace clucida::bench
