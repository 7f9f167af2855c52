/* The torus: all points nearer than `minor` to the circle of radius `major` about the axis.
 *
 * Along a line p(t), with rho the distance from the axis and z the height, R major and r minor,
 *   g(t) = (rho - R)^2 + z^2 - r^2 = |p|^2 + R^2 - r^2 - 2 R rho(t).
 * |p|^2 is a parabola. rho is a branch of a hyperbola, rho^2 = A (t - m)^2 + rho_m^2, and so rho'' = A rho_m^2 / rho^3:
 * g'' = 2 (|d|^2 - R rho'') is below 0 just where rho^3 < R A rho_m^2 / |d|^2, an interval about m, or nowhere. So g
 * is convex, concave, convex along any line. On such a piece Newton's method, begun at an end on the outer side, runs
 * to the first root without passing it: all roots are found and none is invented. g is evaluated as (w - r)(w + r), w =
 * sqrt((rho - R)^2 + z^2), which is as good as a distance. */
#ifndef CLUCIDA_TORUS_H
#define CLUCIDA_TORUS_H

#include "kernels/functions.h"
#include "kernels/span.h"

/* A line as the torus sees it. Its base is the point nearest to the axis, within reach of the torus, so that rho and
 * its slope are sharp where they turn. */
typedef struct {
    real major, minor;
    vec e, ed;                 /* axis x base and axis x d: |e + t ed| is rho */
    real z, dz;                /* the height */
    real dd;                   /* |d|^2 */
    real lo, hi;               /* the torus lies between */
    real bend, width;          /* g is concave from bend - width to bend + width; width < 0: nowhere */
    real shift;                /* parameter of the base on the object's line */
    int left;                  /* the ray has just left the torus, at start */
    real start, rho_start, od; /* od: o . d of its origin, relative to the torus's centre */
} TorusLine;

/* Returns 0 if the line passes the torus by. */
static inline int torus_line(__global const LayoutTorus* torus, const Line* line, int left, TorusLine* l)
{
    const vec n = unit(load_vec(torus->axis)); /* stored to float: not unit enough for double */
    const vec c = load_vec(torus->c);
    const vec o = sub(line->base, c), d = line->d;
    const vec b =
        scaled(cross_exact(d, cross_exact(o, d)), over_square(R(1), line->excess)); /* nearest to the centre */
    l->major = R(torus->major);
    l->minor = R(torus->minor);
    l->dd = R(1) + line->excess;
    l->left = left;
    const real outer = l->major + l->minor, bb = dot3(b, b);
    if (!left && bb >= outer * outer) return 0;

    /* Between the ends of a larger ball and a thicker slab: at both ends the line is surely outside. */
    const real height = dot3(n, b), reach = sqrt(fmax(R(1.125f) * outer * outer - bb, R(0.0625f) * outer * outer));
    l->dz = dot3(n, d);
    l->lo = -reach;
    l->hi = reach;
    if (l->dz != R(0)) {
        const real middle = -height / l->dz, far = R(1.0625f) * l->minor / fabs(l->dz);
        l->lo = fmax(l->lo, middle - far);
        l->hi = fmin(l->hi, middle + far);
    }
    if (!left && (!(l->lo < l->hi) || (l->dz == R(0) && fabs(height) >= l->minor))) return 0;

    l->ed = cross_exact(n, d);
    l->e = cross_exact(n, b);
    l->bend = R(0);
    l->width = R(-1);
    const real a = dot3(l->ed, l->ed);
    real base = R(0);
    if (a > R(0)) {
        const real nearest = -dot3(l->e, l->ed) / a;
        base = fmin(fmax(nearest, l->lo), l->hi);
        l->e = along(l->e, l->ed, base);
        l->bend = -dot3(l->e, l->ed) / a;
        const vec across = along(l->e, l->ed, l->bend);
        const real least = dot3(across, across); /* rho_m^2 */
        if (base == nearest) {
            l->e = across; /* what rounding had left along d is more than nothing where rho is small */
            l->bend = R(0);
        }
        if (sqrt(least) * l->dd < l->major * a) {
            const real rho =
                l->major * cube_root(a * (least / square(l->major)) / l->dd); /* a pure number's, at any scale */
            l->width = sqrt(fmax(rho * rho - least, R(0)) / a);
        }
    }
    l->z = fma(base, l->dz, height);
    l->lo -= base;
    l->hi -= base;
    l->shift = base - over_square(dot3(o, d), line->excess);
    l->start = l->rho_start = l->od = R(0);
    if (left) {
        l->start = line->start - l->shift;
        l->hi = fmax(l->hi, l->start);
        const vec e = along(l->e, l->ed, l->start);
        l->rho_start = sqrt(dot3(e, e));
        l->od = dot_exact(sub(line->origin, c), d);
    }
    return 1;
}

/* The distance from the surface, below 0 inside, and its slope along the line. way (1 or -1) says from which side the
 * axis is seen if t lies on it. */
static inline real torus_distance(const TorusLine* l, real t, real way, real* slope)
{
    const vec e = along(l->e, l->ed, t);
    const real rho = sqrt(dot3(e, e)), z = fma(t, l->dz, l->z);
    const real rise = rho > R(0) ? dot3(e, l->ed) / rho : way * sqrt(dot3(l->ed, l->ed));
    const real across = rho - l->major;
    const real w = sqrt(fma(across, across, z * z));
    *slope = w > R(0) ? fma(across, rise, z * l->dz) / w : R(0);
    return w - l->minor;
}

/* g and its derivative. Where the ray has left the torus, g is 0 by definition, and near there the factor t - start is
 * taken out; further off the distance is sharper:
 * g / (t - start) = 2 o.d + (t - start) |d|^2 - 2 R (rho^2 - rho_start^2) / (t - start) / (rho + rho_start). */
static inline real torus_value(const TorusLine* l, real t, real way, real* slope)
{
    if (!l->left || t - l->start > l->minor) {
        const real distance = torus_distance(l, t, way, slope);
        *slope *= R(2) * (distance + l->minor);
        return distance * (distance + R(2) * l->minor);
    }
    const vec e = along(l->e, l->ed, t);
    const real rho = sqrt(dot3(e, e)), sum = rho + l->rho_start, a = dot3(l->ed, l->ed), ahead = t - l->start;
    const real rise = rho > R(0) ? dot3(e, l->ed) / rho : way * sqrt(a);
    const real quotient = dot3(l->ed, add(e, along(l->e, l->ed, l->start))) / sum;
    const real q = R(2) * (l->od - l->major * quotient) + ahead * l->dd;
    *slope = q + ahead * (l->dd - R(2) * l->major * (a - quotient * rise) / sum);
    return ahead * q;
}

/* Newton's method from `from`, where sign * g is positive and from where it is convex as far as `to`. Returns 1 and the
 * root, or 0 if there is none; certain: there is one, since g has the other sign at `to`. */
static inline int torus_root(const TorusLine* l, real from, real to, real sign, int certain, real* root)
{
    const real way = to > from ? R(1) : R(-1);
    const real small = R(4) * UNIT_ROUNDOFF * (l->major + l->minor);
    real t = from;
    for (int i = 0; i < 64; i++) { /* at a double root it halves, at a fourfold one a quarter goes each time */
        real slope;
        const real h = sign * torus_value(l, t, way, &slope);
        *root = t;
        if (!(sign * way * slope < R(0))) return certain || h <= R(0);
        const real step = -h / (sign * way * slope);
        t += way * step;
        if (!((to - t) * way > R(0))) {
            *root = to;
            return certain;
        }
        if ((t - from) * way < R(0)) t = from;
        *root = t;
        if (h <= R(0) || step <= small) return 1;
    }
    return 1;
}

/* Adds the roots from a to b, between which g is convex, or concave. out: whether the ends lie outside the torus. */
static inline u32 torus_piece(const TorusLine* l, real a, real b, int convex, int out_a, int out_b, real* roots, u32 n)
{
    const real sign = convex ? R(1) : R(-1);
    const int from_a = out_a == convex, from_b = out_b == convex, certain = from_a != from_b;
    real first = a, last = b;
    if (from_a && !torus_root(l, a, b, sign, certain, &first)) return n;
    if (from_b && !torus_root(l, b, a, sign, certain, &last)) return n;
    if (from_a) roots[n++] = first;
    if (from_b) roots[n++] = from_a ? fmax(first, last) : last;
    return n;
}

/* The roots, ascending, from the line's low end on, or after the start of a ray that has left the torus; no more are
 * looked for when `enough` are found. */
#define TORUS_ROOTS 6
static inline u32 torus_roots(const TorusLine* l, int out, u32 enough, real* roots, u32 n)
{
    real a = l->left ? l->start : l->lo;
    int at_start = l->left;
    for (int i = 0; i < 3 && n < enough; i++) {
        const int convex = i != 1;
        real b = l->hi;
        if (i == 0 && l->width >= R(0)) b = fmin(b, l->bend - l->width);
        if (i == 1) b = fmin(b, l->bend + l->width);
        if (!(b > a)) continue;
        real slope;
        int out_b = b >= l->hi || torus_value(l, b, R(1), &slope) > R(0);
        if (at_start && out == convex)
            out_b = out; /* sign * g rises from its root at the start on, and meets no other */
        else
            n = torus_piece(l, a, b, convex, at_start ? !convex : out, out_b, roots, n);
        at_start = 0;
        out = out_b;
        a = b;
    }
    if (n < enough && !out) roots[n++] = l->hi;
    return n;
}

/* The parameter on the object's line of an end of an interval, which is a root, and its slope. */
static inline real torus_end(const TorusLine* l, const Line* line, real t, real* slope)
{
    if (!is_finite(t)) return t;
    real rise;
    torus_distance(l, t, R(1), &rise);
    *slope = R(1) / fabs(rise);
    if (l->left && t == l->start) return line->start;
    return t + l->shift;
}

/* A line has up to two intervals within a torus; part says which. */
static inline Span torus_span(__global const LayoutTorus* torus, const Line* line, u32 part, int left)
{
    TorusLine l;
    real roots[TORUS_ROOTS];
    u32 n = 0;
    if (!torus_line(torus, line, left, &l)) return span_nothing();
    if (part && !left && l.width < R(0)) return span_nothing(); /* convex: two roots at most */
    if (left) {
        if (!line->left_inside) roots[n++] = -INFINITE; /* what lies behind counts no more */
        roots[n++] = l.start;
    }
    n = torus_roots(&l, !left || !line->left_inside, 2u * part + 2u, roots, n);
    if (n < 2u * part + 2u) return span_nothing();

    Span span = make_span(roots[2u * part], roots[2u * part + 1u], R(0), 1);
    span.lo = torus_end(&l, line, span.lo, &span.slope_lo);
    span.hi = torus_end(&l, line, span.hi, &span.slope_hi);
    if (left) { /* on its way to the next root, however near, the ray is on the side that it went to */
        const real next = line->start + least_chord(line->start);
        if (line->left_inside && !part) span.hi = fmax(span.hi, next);
        if (!line->left_inside && part) span.lo = fmax(span.lo, next);
    }
    /* Rounding blurs an end that is met at a slant, but not as far as the interval's other end. */
    const real most = R(0.25f) * (span.hi - span.lo);
    if (!(left && span.lo == line->start))
        span.slope_lo = fmin(span.slope_lo, most / (line_error(line, span.lo) + line->err));
    if (!(left && span.hi == line->start))
        span.slope_hi = fmin(span.slope_hi, most / (line_error(line, span.hi) + line->err));
    return span;
}

/* Outward normal; *p moves onto the surface. */
static inline vec torus_normal(__global const LayoutTorus* torus, vec* p)
{
    const vec axis = unit(load_vec(torus->axis));
    const vec c = load_vec(torus->c), x = sub(*p, c);
    const real z = dot_exact(axis, x);
    vec across = along(x, axis, -z);
    across = along(across, axis, -dot3(across, axis));
    const real rho = sqrt(dot3(across, across));
    const vec out = scaled(across, R(1) / fmax(rho, R(0.5f) * (R(torus->major) - R(torus->minor))));
    const vec n = unit(along(scaled(axis, z), out, rho - R(torus->major)));
    *p = along(along(c, out, R(torus->major)), n, R(torus->minor));
    return n;
}

#endif
