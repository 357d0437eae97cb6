/* The picture of what is smooth already and coarser than a pixel: enlarged in space, by a quadratic
 * that keeps the samples themselves (Dodgson 1997), within what they span: nothing is darker beside
 * a lamp. */
#include "lib/camera.h"
#include "shared/planes.h"
#include "upscale/current.h"

/* A column of samples for each lane; beyond the edge of the plane its outermost one goes on. */
typedef struct Column {
    Int x;
    int first;  /* the sixteen columns from here on hold all of them ... */
    Int lane;   /* ... at these places */
    bool close; /* if they do */
} Column;

MACULA_ALWAYS_INLINE Column column_of(const Source* s, int i) {
    Column c;
    c.x = clamp(s->x + i, splat_int(0), splat_int(s->width - 1));
    c.first = clamp(s->first_x + i, 0, max(s->width - 16, 0));
    c.lane = c.x - c.first;
    c.close = s->width >= 16 && !any_lane((c.lane & 15) != c.lane);
    return c;
}

/* Those around each lane's pixel. */
typedef struct Columns {
    Column before, middle, after;
    bool close;
    Weights3 weights;
} Columns;

MACULA_ALWAYS_INLINE Columns columns_of(const Source* s) {
    Columns c;
    c.before = column_of(s, -1);
    c.middle = column_of(s, 0);
    c.after = column_of(s, 1);
    c.close = c.before.close && c.middle.close && c.after.close;
    c.weights = quadratic_weights(s->to_x);
    return c;
}

MACULA_ALWAYS_INLINE Real within(Real value, Real a, Real b, Real c) {
    return clamped(value, m_min(m_min(a, b), c), m_max(m_max(a, b), c));
}

MACULA_ALWAYS_INLINE Real weighed(const Columns* c, Real before, Real middle, Real after) {
    const Real outer = fma(c->weights.w[1], middle, c->weights.w[2] * after);
    return within(fma(c->weights.w[0], before, outer), before, middle, after);
}

#if MACULA_LANES == 16
MACULA_ALWAYS_INLINE Real close_column(global const float* row, const Column* c) {
    return permuted16(vload16(0, row + c->first), c->lane);
}

MACULA_ALWAYS_INLINE Real between_close(global const float* row, const Columns* c) {
    return weighed(c, close_column(row, &c->before), close_column(row, &c->middle),
                   close_column(row, &c->after));
}
#endif

MACULA_ALWAYS_INLINE Real between_any(global const float* row, const Columns* c) {
    return weighed(c, MACULA_GATHER(float, row, c->before.x, ),
                   MACULA_GATHER(float, row, c->middle.x, ),
                   MACULA_GATHER(float, row, c->after.x, ));
}

/* A row of samples between its columns. */
MACULA_ALWAYS_INLINE Real3 row_between(global const float* planes, uint pixels, const Source* s,
                                       const Columns* c, int y) {
    global const float* row = planes + clamp(y, 0, s->height - 1) * s->width;
#if MACULA_LANES == 16
    if (c->close)
        return make3(between_close(row, c), between_close(row + pixels, c),
                     between_close(row + 2u * pixels, c));
#endif
    return make3(between_any(row, c), between_any(row + pixels, c),
                 between_any(row + 2u * pixels, c));
}

/* One work-item a strip of MACULA_ENLARGED_ROWS rows: neighbouring rows of the picture lie between
 * the same rows of samples, which are read and weighed by columns once. */
kernel void enlarge(global const FrameParams* restrict frame, uint target_width, uint target_height,
                    global const float* restrict planes, global float4* restrict picture) {
    Strip s = strip_of_item(target_width, target_height);
    s.y *= (int)MACULA_ENLARGED_ROWS;
    if (s.y >= s.height)
        return;
    const int width = (int)frame->width, height = (int)frame->height;
    const uint pixels = frame->width * frame->height;
    const float across = m_divide((float)width, (float)s.width);
    const float down = m_divide((float)height, (float)s.height);
    const Real zero = splat(0.0f);
    const Source source = source_of(&s, width, height, across, down, zero, zero);
    const Columns columns = columns_of(&source);
    int row = source.first_y;
    Real3 above = row_between(planes, pixels, &source, &columns, row - 1);
    Real3 middle = row_between(planes, pixels, &source, &columns, row);
    Real3 below = row_between(planes, pixels, &source, &columns, row + 1);
    const int end = min(s.y + (int)MACULA_ENLARGED_ROWS, s.height);
    for (; s.y < end; ++s.y) {
        const float y = fma((float)s.y + 0.5f, down, -0.5f), nearest = rint(y);
        for (; row < (int)nearest; ++row) {
            above = middle;
            middle = below;
            below = row_between(planes, pixels, &source, &columns, row + 2);
        }
        const Weights3 rows = quadratic_weights(splat(y - nearest));
        const Real3 outer = scale_add3(middle, rows.w[1], scale3(below, rows.w[2]));
        const Real3 sum = scale_add3(above, rows.w[0], outer);
        const Real3 kept = make3(within(sum.x, above.x, middle.x, below.x),
                                 within(sum.y, above.y, middle.y, below.y),
                                 within(sum.z, above.z, middle.z, below.z));
        store_colours(picture, &s, kept);
    }
}
