/// Where a frame's time goes is found by rendering it otherwise: with a part of the work left out, done twice, or done
/// in another way.
#pragma once

#include "host/renderer.h"
#include "host/statistics.h"
#include "scene/compile.h"

#include <string>
#include <vector>

namespace clucida::bench {

enum class How {
    whole,    ///< nothing changed: what the others are held against
    left_out, ///< what it lacks costs what it saves
    twice,    ///< what is done twice costs what it adds; the picture stays the same
    instead   ///< another way to the whole picture: it has a ratio, and costs nothing by itself
};

/// What a frame's work is divided into; of some rows the cost is a stage's.
enum class Stage { none, observer, search, confirm, full, shadow };

struct Ablation {
    std::string name; ///< for people: what is left out, done twice or put in place
    How how = How::whole;
    scene::Compiled compiled; ///< the scene as it is rendered
    host::RenderSettings settings;
    /// The cost divided by this many is what one costs, ns; nullptr: none are to be named.
    std::uint64_t host::Statistics::*each = nullptr;
    Stage stage = Stage::none; ///< observer: the row's time; else its cost
};

/// What a scene's ablations are made of.
struct AblationScene {
    const scene::Compiled& compiled; ///< with capacities that suffice
    const scene::Compiled& one_hop;  ///< the same with rays of one segment
    const host::DeviceInfo& device;
    host::KernelShape kernel = host::KernelShape::pixels; ///< that renders the whole
    host::Statistics counted;                             ///< of the whole
};

/// The whole, then all that say something of the scene: there is no row for what it has none of.
std::vector<Ablation> make_ablations(const AblationScene& scene, const host::RenderSettings& settings);

/// The kernels' text with the files of bench/variants/stages/NAME, or of bench/variants/half, laid over.
/// @throws std::invalid_argument if there is no such folder
host::FileTexts stage_kernels(const std::string& name);

} // namespace clucida::bench
