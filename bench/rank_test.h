/// Whether two samples of times differ by more than chance: the test of Mann, Whitney and Wilcoxon.
#pragma once

#include <vector>

namespace clucida::bench {

/// The probability, 0..1, that two samples of one distribution have rank sums as far apart as these or farther (two
/// sided). Exact without ties for samples of up to 50 values each, else by the normal approximation with corrections
/// for ties and continuity. 1 if either is empty. Mann and Whitney, Annals of Mathematical Statistics 18 (1947).
double rank_test(const std::vector<double>& a, const std::vector<double>& b);

} // namespace clucida::bench
