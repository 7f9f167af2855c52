/// Where numbers lie on an axis of a plot, and which of them are written beside it.
#pragma once

#include "bench/plot.h"

#include <string>
#include <vector>

namespace clucida::bench {

/// Maps least..most to 0..1.
class AxisRange {
public:
    /// The range of the values with a little air, ending at ticks. On a logarithmic axis values are above 0. Of no
    /// values the range is 1..10.
    AxisRange(Scale scale, const std::vector<double>& values);

    double place(double value) const;
    const std::vector<double>& ticks() const { return ticks_; }     ///< with numbers
    const std::vector<double>& fine_ticks() const { return fine_; } ///< without

private:
    void choose_linear(double least, double most);
    void choose_logarithmic(double least, double most);

    Scale scale_;
    double begin_ = 1, end_ = 10;
    std::vector<double> ticks_, fine_;
};

/// 1, 2 or 5 times a power of ten: a step that divides the span into at most that many parts.
double nice_step(double span, unsigned most_parts);

/// A tick as text: "0.001", "1e-06", "20", "5k", "2M"
std::string tick_text(double value);

} // namespace clucida::bench
