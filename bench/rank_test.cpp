#include "bench/rank_test.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace clucida::bench {
namespace {

constexpr std::size_t most_exact = 50;

struct Ranks {
    double u = 0;       ///< pairs in which a's value is the larger, ties as halves
    double tie_sum = 0; ///< of t^3 - t over groups of t equal values
};

Ranks rank(const std::vector<double>& a, const std::vector<double>& b)
{
    Ranks out;
    for (const double x : a)
        for (const double y : b) out.u += x > y ? 1 : x == y ? 0.5 : 0;
    std::vector<double> all = a;
    all.insert(all.end(), b.begin(), b.end());
    std::ranges::sort(all);
    for (auto begin = all.begin(); begin != all.end();) {
        const auto end = std::upper_bound(begin, all.end(), *begin);
        const auto t = static_cast<double>(end - begin);
        out.tie_sum += t * t * t - t;
        begin = end;
    }
    return out;
}

/// How probable each U is, of samples of n and m values without ties. Adding a value to one sample, the last of all
/// ranks is either its own or the other sample's: f(u; n, m) = f(u - m; n - 1, m) + f(u; n, m - 1).
std::vector<double> distribution(std::size_t n, std::size_t m)
{
    std::vector<std::vector<double>> row(m + 1, std::vector<double>(n * m + 1)); // of one n, by m and u
    for (std::size_t j = 0; j <= m; ++j) row[j][0] = 1;
    for (std::size_t i = 1; i <= n; ++i) {
        std::vector<std::vector<double>> next(m + 1, std::vector<double>(n * m + 1));
        next[0][0] = 1;
        for (std::size_t j = 1; j <= m; ++j)
            for (std::size_t u = 0; u <= i * j; ++u) next[j][u] = (u >= j ? row[j][u - j] : 0) + next[j - 1][u];
        row = std::move(next);
    }
    double sum = 0;
    for (const double count : row[m]) sum += count;
    for (double& count : row[m]) count /= sum;
    return row[m];
}

double exact(double u, std::size_t n, std::size_t m)
{
    const std::vector<double> probability = distribution(n, m);
    const auto least = static_cast<std::size_t>(std::min(u, static_cast<double>(n * m) - u));
    double sum = 0;
    for (std::size_t i = 0; i <= least; ++i) sum += probability[i];
    return std::min(1.0, 2 * sum);
}

double approximate(const Ranks& ranks, std::size_t n, std::size_t m)
{
    const auto a = static_cast<double>(n), b = static_cast<double>(m), all = a + b;
    const double variance = a * b / 12 * (all + 1 - ranks.tie_sum / (all * (all - 1)));
    if (variance <= 0) return 1;
    const double distance = std::max(std::fabs(ranks.u - a * b / 2) - 0.5, 0.0);
    return std::erfc(distance / std::sqrt(2 * variance));
}

} // namespace

double rank_test(const std::vector<double>& a, const std::vector<double>& b)
{
    if (a.empty() || b.empty()) return 1;
    const Ranks ranks = rank(a, b);
    const bool is_exact = ranks.tie_sum == 0 && std::max(a.size(), b.size()) <= most_exact;
    return is_exact ? exact(ranks.u, a.size(), b.size()) : approximate(ranks, a.size(), b.size());
}

} // namespace clucida::bench
