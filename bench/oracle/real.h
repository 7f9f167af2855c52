/// The real types that the oracle runs in, and one set of names for their functions.
#pragma once

#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <quadmath.h>

namespace clucida::oracle {

__extension__ using Quad = __float128;
using Big =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50, boost::multiprecision::allocate_stack>,
                                  boost::multiprecision::et_off>;

using std::acos;
using std::asin;
using std::atan2;
using std::cos;
using std::exp;
using std::fabs;
using std::floor;
using std::log;
using std::sin;
using std::sqrt;
using std::tan;

inline Quad acos(Quad x)
{
    return acosq(x);
}
inline Quad asin(Quad x)
{
    return asinq(x);
}
inline Quad atan2(Quad y, Quad x)
{
    return atan2q(y, x);
}
inline Quad cos(Quad x)
{
    return cosq(x);
}
inline Quad exp(Quad x)
{
    return expq(x);
}
inline Quad fabs(Quad x)
{
    return x < 0 ? -x : x;
}
inline Quad floor(Quad x)
{
    return floorq(x);
}
inline Quad log(Quad x)
{
    return logq(x);
}
inline Quad sin(Quad x)
{
    return sinq(x);
}
inline Quad sqrt(Quad x)
{
    return sqrtq(x);
}
inline Quad tan(Quad x)
{
    return tanq(x);
}

/// The distance from 1 to the next number. (std::numeric_limits knows nothing of __float128 without extensions.)
template <class Real>
double epsilon()
{
    return 0x1p-52;
}
template <>
inline double epsilon<long double>()
{
    return 0x1p-63;
}
template <>
inline double epsilon<Quad>()
{
    return 0x1p-112;
}
template <>
inline double epsilon<Big>()
{
    return 0x1p-166;
}

template <class Real>
const Real& pi()
{
    static const Real value = acos(Real(-1));
    return value;
}

template <class Real>
double to_double(const Real& x)
{
    return static_cast<double>(x);
}

template <class Real>
Real smaller(const Real& a, const Real& b)
{
    return b < a ? b : a;
}
template <class Real>
Real larger(const Real& a, const Real& b)
{
    return a < b ? b : a;
}

} // namespace clucida::oracle
