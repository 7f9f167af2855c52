/// Real roots of polynomials of degree 4 at most, for the torus.
#pragma once

#include "bench/oracle/real.h"

#include <array>
#include <vector>

namespace clucida::oracle {

/// c[0] + c[1] t + ... + c[degree] t^degree.
template <class Real>
struct Polynomial {
    std::array<Real, 5> c{};
    int degree = 4;
};

template <class Real>
Real value(const Polynomial<Real>& p, const Real& t)
{
    Real sum = p.c[p.degree];
    for (int i = p.degree - 1; i >= 0; i--) sum = sum * t + p.c[i];
    return sum;
}

template <class Real>
Polynomial<Real> derivative(const Polynomial<Real>& p)
{
    Polynomial<Real> d;
    d.degree = p.degree - 1;
    for (int i = 1; i <= p.degree; i++) d.c[i - 1] = p.c[i] * Real(i);
    return d;
}

/// p / (t - root), the remainder dropped.
template <class Real>
Polynomial<Real> deflated(const Polynomial<Real>& p, const Real& root)
{
    Polynomial<Real> q;
    q.degree = p.degree - 1;
    Real carry = p.c[p.degree];
    for (int i = p.degree - 1; i >= 0; i--) {
        q.c[i] = carry;
        carry = p.c[i] + carry * root;
    }
    return q;
}

/// The root between low and high, where the values' signs differ: Newton's method, kept within the bracket by
/// bisection.
template <class Real>
Real bracketed_root(const Polynomial<Real>& p, const Polynomial<Real>& slope, Real low, Real high)
{
    const bool rises = value(p, low) < 0;
    Real t = (low + high) / Real(2);
    for (int i = 0; i < 400; i++) {
        const Real y = value(p, t);
        if (y == 0) return t;
        if ((y < 0) == rises)
            low = t;
        else
            high = t;
        const Real s = value(slope, t);
        Real next = s == 0 ? low : t - y / s;
        if (!(next > low && next < high)) next = (low + high) / Real(2);
        if (fabs(next - t) <= Real(epsilon<Real>()) * fabs(t) || next == low || next == high) return next;
        t = next;
    }
    return t;
}

/// All real roots within -bound..bound, ascending. Between neighbouring extrema there is at most one. An extremum that
/// touches zero counts as none: nothing is crossed there.
template <class Real>
std::vector<Real> real_roots(const Polynomial<Real>& p, const Real& bound)
{
    if (p.degree < 1) return {};
    const Polynomial<Real> slope = derivative(p);
    std::vector<Real> ends{-bound};
    for (const Real& t : real_roots(slope, bound)) ends.push_back(t);
    ends.push_back(bound);
    std::vector<Real> roots;
    for (std::size_t i = 0; i + 1 < ends.size(); i++) {
        const Real a = value(p, ends[i]), b = value(p, ends[i + 1]);
        if ((a < 0) == (b < 0)) continue;
        roots.push_back(bracketed_root(p, slope, ends[i], ends[i + 1]));
    }
    return roots;
}

} // namespace clucida::oracle
