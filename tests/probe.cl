/* Single questions to the core, one a work-item, for tests: the next surface, what arrives along a ray, and the
 * functions of optics.h and color.h. render.cl's kernel comes along. */
#include "kernels/render.cl"

static inline vec probe_vec(__global const real* p)
{
    return make_vec(p[0], p[1], p[2]);
}

static inline void probe_store(__global real* to, vec v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

/* Numbers: origin, direction, err. Marks: left, left_inside, the first of its objects and their count. */
static inline Ray probe_ray(__global const real* numbers, __global const uint* marks)
{
    Ray ray;
    ray.o = probe_vec(numbers);
    ray.d = renormalized(probe_vec(numbers + 3));
    ray.excess = length_excess(ray.d);
    ray.left = marks[0];
    ray.left_inside = (int)marks[1];
    ray.err = ray.left == MEMBER_NONE ? R(0) : numbers[6];
    return ray;
}

static inline void probe_count(const World* world, __global uint* stats)
{
    for (uint k = 0; k < STAT_COUNT; k++)
        if (world->stats[k]) atomic_add(&stats[k], world->stats[k]);
}

/* Answers: t, p, n, err; and found, object, before, after, left, beyond_inside. */
__kernel void probe_surface(SCENE_PARAMETERS, __global const real* restrict numbers,
                            __global const uint* restrict marks, __global const uint* restrict inside,
                            __global real* restrict answers, __global uint* restrict answer_marks,
                            __global uint* restrict stats)
{
    const size_t item = get_global_id(0);
    World world = SCENE_WORLD;
    const Ray ray = probe_ray(numbers + 7 * item, marks + 4 * item);
    uint medium = VACUUM;
    for (uint i = 0; i < marks[4 * item + 3]; i++) medium = min(medium, inside[marks[4 * item + 2] + i]);
    Surface s;
    __global uint* out = answer_marks + 6 * item;
    out[0] = (uint)next_surface(&world, &ray, medium, &s);
    probe_count(&world, stats);
    if (!out[0]) return;
    answers[8 * item] = s.t;
    answers[8 * item + 7] = s.err;
    probe_store(answers + 8 * item + 1, s.p);
    probe_store(answers + 8 * item + 4, s.n);
    out[1] = s.object;
    out[2] = s.before;
    out[3] = s.after;
    out[4] = s.left;
    out[5] = (uint)s.beyond_inside;
}

/* Answers: r, g, b. */
__kernel void probe_trace(SCENE_PARAMETERS, __global const real* restrict numbers, __global const uint* restrict marks,
                          __global real* restrict answers, __global uint* restrict stats)
{
    const size_t item = get_global_id(0);
    World world = SCENE_WORLD;
    Branch branch;
    branch.ray = probe_ray(numbers + 7 * item, marks + 4 * item);
    branch.throughput = branch.weight = grey(R(1));
    branch.hops = frame->max_hops;
    branch.medium = VACUUM;
    const rgb color = trace(&world, &branch);
    answers[3 * item] = color.r;
    answers[3 * item + 1] = color.g;
    answers[3 * item + 2] = color.b;
    probe_count(&world, stats);
}

/* Numbers: d, n, w. Answers: whether it passes, the refracted direction, the reflectance, the reflected direction. */
__kernel void probe_bend(__global const real* restrict numbers, __global real* restrict answers)
{
    const vec d = probe_vec(numbers), n = probe_vec(numbers + 3);
    const real w = numbers[6], cosine = -dot3(d, n), det = refraction_det(w, cosine);
    answers[0] = det >= R(0) ? R(1) : R(0);
    probe_store(answers + 5, reflected(d, n, cosine));
    if (!(det >= R(0))) return;
    probe_store(answers + 1, refracted(d, n, w, cosine, det));
    answers[4] = fresnel_reflectance(w, cosine, det);
}

/* Numbers: cosine, distance. */
__kernel void probe_diffuse(__global const real* restrict numbers, const uint law, __global real* restrict answers)
{
    answers[0] = diffuse(law, numbers[0], numbers[1]);
}

__kernel void probe_filter(const uint packed, __global real* restrict answers)
{
    const rgb c = unpack_filter(packed);
    answers[0] = c.r;
    answers[1] = c.g;
    answers[2] = c.b;
}
