#include "bench/compiled_views.h"

#include <algorithm>

namespace clucida::bench {

CompiledViews::CompiledViews(const SpeedTask& task)
    : source_(host::load_scene(task.scene)), least_interior_(task.least_interior), least_stack_(task.least_stack)
{
}

const scene::Compiled& CompiledViews::at(const SpeedView& view)
{
    if (ready_ && view == view_) return compiled_;
    compiled_ = {};
    compiled_ = host::compile_scene(source_, source_.scene, view_of(view), &photographs_);
    view_ = view;
    ready_ = true;
    scene::Needs& needs = compiled_.needs;
    needs.interior = std::max(needs.interior, least_interior_);
    needs.stack = std::max(needs.stack, least_stack_);
    for (const auto& [of, known] : kept_)
        if (of == view) needs = known;
    return compiled_;
}

void CompiledViews::keep(const scene::Needs& needs)
{
    if (needs == compiled_.needs) return;
    compiled_.needs = needs;
    std::erase_if(kept_, [&](const auto& entry) { return entry.first == view_; });
    kept_.emplace_back(view_, needs);
}

} // namespace clucida::bench
