#include "host/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace clucida::host {

ProgressBar::ProgressBar(std::string label, bool wanted)
    : label_(std::move(label)), shown_(wanted && ::isatty(STDERR_FILENO))
{
}

ProgressBar::~ProgressBar()
{
    if (shown_ && last_ >= 0) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::update(double fraction)
{
    constexpr int width = 30;
    const double now = watch_.seconds();
    if (!shown_ || (now - last_ < 0.1 && fraction < 1)) return;
    last_ = now;
    const int full = static_cast<int>(fraction * width);
    const std::string rest =
        fraction > 0 && now > 0.5 ? fmt::format("  {:.0f} s left", now * (1 - fraction) / fraction) : "";
    fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {:3.0f} %{}\x1b[K", label_, "", full, "", width - full, fraction * 100,
               rest);
    std::fflush(stderr);
}

} // namespace clucida::host
