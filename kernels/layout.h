/* The one header that host and kernels share: what lies in the scene's buffers.
 *
 * Every struct holds 4-byte scalars only, so that its layout is the same for every compiler; the host asserts
 * sizes and offsets (scene/layout_check.cpp). Lengths are in scene units. Positions are relative to the observer's
 * eye (subtracted in double on the host); positions inside an object are relative to the object's centre.
 */
#ifndef CLUCIDA_LAYOUT_H
#define CLUCIDA_LAYOUT_H

#ifdef __OPENCL_VERSION__
typedef uint u32;
typedef ulong u64;
#else
#include <stdint.h>
typedef uint32_t u32;
typedef uint64_t u64;
#endif

/* The scene's buffers, in the order of the kernel's arguments. */
enum LayoutBuffer {
    BUFFER_FRAME,    /* one LayoutFrame */
    BUFFER_NODES,    /* LayoutNode: first the roots */
    BUFFER_OBJECTS,  /* LayoutObject, in order of precedence */
    BUFFER_GROUPS,   /* LayoutGroup */
    BUFFER_MEMBERS,  /* u32 references, see MEMBER_* */
    BUFFER_PROGRAMS, /* u32 boolean programs, see OP_* */
    BUFFER_PLANES,   /* LayoutPlane */
    BUFFER_BLOCKS,   /* LayoutPlaneBlock */
    BUFFER_SPHERES,  /* LayoutSphere */
    BUFFER_QUADRICS, /* LayoutQuadric */
    BUFFER_TORI,     /* LayoutTorus */
    BUFFER_OPTICS,   /* LayoutOptics */
    BUFFER_TEXTURES, /* LayoutTexture */
    BUFFER_IMAGES,   /* LayoutImage */
    BUFFER_TEXELS,   /* u32, 0x00BBGGRR, rows from the top */
    BUFFER_LIGHTS,   /* LayoutLight */
    BUFFER_COUNT
};

/* A reference to a primitive: kind | inverse | index. A ray that leaves a surface names it by the reference without
 * its inverse bit and part. */
#define MEMBER_KIND 3u
#define MEMBER_PLANE 0u
#define MEMBER_SPHERE 1u
#define MEMBER_QUADRIC 2u
#define MEMBER_TORUS 3u /* one of the two intervals that a line may have in it: MEMBER_PART says which */
#define MEMBER_INVERSE 4u
#define MEMBER_SHIFT 3u
#define MEMBER_PART 8u /* of a torus only: the second interval, not the first; its index lies a bit higher */
#define MEMBER_NONE 0xffffffffu

/* Half-space dot(n, p) < h, n unit. */
typedef struct {
    float n[3];
    float h;
} LayoutPlane;

/* Eight planes of one group side by side; where there are fewer, the last lanes hold all of space (n 0, h 1e30). */
#define PLANE_BLOCK 8u
typedef struct {
    float n[3][PLANE_BLOCK];
    float h[PLANE_BLOCK];
    u32 plane[PLANE_BLOCK]; /* into planes, or PLANE_NONE */
} LayoutPlaneBlock;
#define PLANE_NONE 0x1fffffffu

typedef struct {
    float c[3];
    float r;
} LayoutSphere;

/* A quadric in a frame that makes its coefficients small whole numbers: with X = m (p - c),
 * q(X) = s0 X0^2 + s1 X1^2 + s2 X2^2 - 2 g X2 + w, inside where q < 0. */
typedef struct {
    float c[3];
    float m[9];
    float s[3];
    float g;
    float w;
    float norm; /* of m: no vector becomes longer than this many times its length, by m or its transpose */
} LayoutQuadric;

/* Nearer than minor to the circle of radius major about the axis (unit) through c. */
typedef struct {
    float c[3];
    float axis[3];
    float major, minor; /* minor < major */
} LayoutTorus;

/* A convex set (an intersection of members and blocks of planes), or one member of any kind; or the complement of it.
 * On a line it is one interval or the complement of one. */
typedef struct {
    u32 begin; /* into members */
    u32 count;
    u32 single;                   /* of the members: they are met one by one, the rest, all planes, in blocks */
    u32 block_begin, block_count; /* into blocks */
    u32 inverse;
} LayoutGroup;

/* Of the tree over the objects' boxes. bounds: least x, y, z, greatest x, y, z of each child; of a child that there is
 * not the least is infinite and the greatest is minus that. */
typedef struct {
    float bounds[6][8];
    u32 child[8]; /* an object, or NODE_INNER and a node */
} LayoutNode;
#define NODE_INNER 0x80000000u
/* As many objects make no tree: in nodes that are all roots they are as well looked at one after the other. */
#define LIST_CAPACITY 64u

/* Object: a boolean expression over groups: the intersection of all when program_count is 0. */
typedef struct {
    float center[3];
    float radius; /* of the bounding sphere; infinite if there is none */
    float near;   /* from farther away than this a ray's line starts near the centre (line.h); may be infinite */
    float grain;  /* the largest length among its members: what they were rounded by as they were stored */
    u32 form;     /* FORM_* */
    u32 group_begin, group_count;
    u32 program_begin, program_count;
    u32 optics;
    u32 texture;   /* TEXTURE_NONE or an index */
    u32 sole;      /* the member of an object that has no other; MEMBER_NONE: look into its groups */
    u32 unused[2]; /* so that an object fills a line of the cache */
} LayoutObject;
#define FORM_ALL 0u     /* the intersection of its groups */
#define FORM_ANY 1u     /* their union; it has a program too */
#define FORM_PROGRAM 2u /* what its program says */
#define TEXTURE_NONE 0xffffffffu

/* A boolean program in reverse Polish order over a stack of bits: OP_GROUP | i<<2 pushes whether the point is inside
 * group i of the object; OP_AND | n<<2, OP_OR | n<<2 reduce the n topmost bits. */
#define OP_GROUP 0u
#define OP_AND 1u
#define OP_OR 2u
#define OP_MASK 3u
#define OP_SHIFT 2u
#define PROGRAM_MAX_DEPTH 32u

/* Filters are 32-bit: the square roots of r, g, b at 11, 11, 10 bits (color.h). Extinction is -ln of the passthrough
 * per unit of length: 0 is perfectly clear. */
typedef struct {
    u32 reflection;
    u32 absorption;
    u32 refraction;
    float index; /* 0 opaque, < 0 emits its refraction colour */
    float extinction[3];
    u32 flags;
    float rank; /* for the media rule of the original program (rayt) */
} LayoutOptics;
#define OPTICS_FRESNEL 1u

typedef struct {
    u32 offset; /* first texel */
    u32 width, height;
    u32 flags;
} LayoutImage;
#define IMAGE_LINEAR 1u      /* texels are linear light; else sRGB */
#define IMAGE_INTERPOLATE 2u /* bilinear; else the texel that is hit */

/* Texture: uv from a point p or normal n of the surface, in the frame x, y, z (unit vectors, or scaled for planar).
 * origin is relative to the eye. wrap: see texture.h. */
typedef struct {
    u32 image;
    u32 mapping;
    float x[3], y[3], z[3];
    float origin[3];
    float scale; /* 1/|n| */
    float wrap[2];
    u32 reflection, absorption, refraction; /* factors of the photograph, packed as filters */
} LayoutTexture;
#define MAPPING_DIRECTIONAL 0u
#define MAPPING_POSITIONAL 1u
#define MAPPING_RELATIVE 2u
#define MAPPING_LINEAR 3u
#define MAPPING_PLANAR 4u

typedef struct {
    float point[3];
    float color[3];
} LayoutLight;

/* What holds for the whole picture. A pixel (i, j) and sample offset (a, b) in 0..1 give
 * u = (i + a)/width - 1/2, v = (j + b)/height - 1/2, s = u column + v row;
 * the ray starts at window*s and goes along forward + s. */
typedef struct {
    u32 width, height;
    float forward[3];
    float column[3]; /* times the aspect ratio already */
    float row[3];    /* downwards in the picture */
    float window;    /* 1: the rays start on a window at the eye; 0: at the eye */
    u32 corner;      /* 1: one sample lies in the pixel's upper left corner, as gun's do */
    u32 samples;     /* of a pixel in all */
    u32 max_hops;
    float cutoff;
    u32 object_count, light_count;
    u32 start_count;  /* objects that may hold the start of an observer's ray */
    u32 root_count;   /* of nodes */
    u32 walk_reserve; /* how many nodes and objects the deepest branch of the tree leaves waiting */
    u32 light_law;
    u32 media_rule;
    u32 sky;
    u32 sky_image;
    float sky_axis[3];                            /* gradient: unit, up */
    float sky_low[3], sky_middle[3], sky_high[3]; /* gradient: nadir, horizon, zenith; colour: sky_low */
} LayoutFrame;
#define LAW_PAPER 0u          /* (2/pi) acos(1 - cos) */
#define LAW_LAMBERT 1u        /* cos */
#define LAW_INVERSE_SQUARE 2u /* cos / distance^2 */
#define MEDIA_NEAREST 0u
#define MEDIA_RANK 1u /* rayt's */
#define SKY_COLOR 0u
#define SKY_GRADIENT 1u
#define SKY_RGB 2u
#define SKY_HSV 3u
#define SKY_PHOTOGRAPH 4u

/* Statistics: STAT_SLOTS rows of STAT_COUNT counters; a work-item adds to row (its number mod STAT_SLOTS). */
enum LayoutStat {
    STAT_RAYS,              /* rays of all kinds that were traced, shadow rays apart */
    STAT_PRIMARY,           /* ... from the observer */
    STAT_REFLECTED,         /* ... after a reflection */
    STAT_REFRACTED,         /* ... after a refraction */
    STAT_SHADOW,            /* shadow rays */
    STAT_QUERIES,           /* nearest-crossing searches */
    STAT_FULL,              /* ... that took the full search */
    STAT_TESTS,             /* objects tested past their bound */
    STAT_SILENT,            /* crossings without optical effect */
    STAT_PARITY,            /* interior contradicted by geometry: must be 0 */
    STAT_NAN,               /* samples that were not a number: must be 0 */
    STAT_INTERIOR_OVERFLOW, /* objects dropped from a full interior: must be 0, the host enlarges it */
    STAT_STACK_OVERFLOW,    /* branches dropped from a full stack: must be 0 */
    STAT_STUCK,             /* rays given up after too many silent crossings: must be 0 */
    STAT_CUT_BRANCHES,      /* rays ended by the cutoff */
    STAT_HOP_BRANCHES,      /* rays ended by the hop limit */
    STAT_TRUNCATED,         /* weight (largest channel) of both, in units of 2^-16 */
    STAT_COUNT
};
#define STAT_SLOTS 64
#define STAT_NEXT (STAT_SLOTS * STAT_COUNT) /* behind them: the next block of packets (render_packets.cl) */

/* What a traced segment came to (signature.h), in the order of tracing: a segment, then what its reflection led to,
 * then what its refraction led to. A branch that is black at once is not traced and has no event. */
typedef struct {
    u32 hop;    /* 0: the observer's segment */
    u32 object; /* whose surface ends the segment; EVENT_NONE: the sky does */
    u32 face;   /* the primitive, as a ray that leaves it names it */
    u32 what;   /* EVENT_* bits */
    u32 lights; /* bit i mod 32: light i lit the surface */
} LayoutEvent;
#define EVENT_NONE 0xffffffffu
#define EVENT_ENTERING 1u  /* the object is entered, not left */
#define EVENT_REFLECTED 2u /* the reflection was followed */
#define EVENT_REFRACTED 4u /* the refraction was followed */
#define EVENT_TOTAL 8u     /* past the critical angle */
#define EVENT_EMITTED 16u  /* an emitter ended the ray */
#define RAY_NUMBERS 9u     /* of a segment's ray: its origin, relative to the eye, its direction, the throughput */

#endif
