#include "draw/colour_scale.h"

#include <math.h>

/* A colour in OKLab: lightness (0 black, 1 white), green to red, blue to yellow. */
typedef struct oklab {
    double l, a, b;
} oklab;

/* A colour as lightness, chroma and hue (degrees). */
typedef struct oklch {
    double l, c, h;
} oklch;

/* A curve of colours: it starts at `from`, is drawn towards `by`, and ends at `to`. */
typedef struct arc {
    oklch from, by, to;
} arc;

static const arc warm[2] = {{{0.95, 0.075, 100}, {0.72, 0.215, 62}, {0.28, 0.085, 22}},
                            {{0.25, 0.06, 22}, {0.62, 0.215, 50}, {0.95, 0.08, 100}}};
static const arc cool[2] = {{{0.965, 0.015, 230}, {0.70, 0.10, 245}, {0.34, 0.10, 264}},
                            {{0.24, 0.05, 264}, {0.60, 0.13, 250}, {0.93, 0.04, 215}}};
static const arc grey[2] = {{{0.90, 0.004, 250}, {0.65, 0.006, 250}, {0.42, 0.01, 250}},
                            {{0.34, 0.01, 250}, {0.60, 0.006, 250}, {0.85, 0.003, 250}}};
static const arc below_zero[2] = {{{0.37, 0.13, 262}, {0.60, 0.16, 250}, {0.96, 0.0, 0}},
                                  {{0.85, 0.08, 230}, {0.55, 0.15, 250}, {0.24, 0.0, 0}}};
static const arc above_zero[2] = {{{0.96, 0.0, 0}, {0.60, 0.20, 45}, {0.37, 0.125, 25}},
                                  {{0.24, 0.0, 0}, {0.55, 0.16, 40}, {0.87, 0.11, 75}}};

/* viridis, every eighth of its 256 colours. */
static const uint32_t viridis[33] = {
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453781, 0x424086, 0x3e4989, 0x3b528b, 0x375b8d, 0x33638d,
    0x2f6b8e, 0x2c728e, 0x297a8e, 0x26828e, 0x23898e, 0x21908c, 0x1f978b, 0x1f9f88, 0x21a685, 0x27ad81, 0x31b57b,
    0x3ebc74, 0x4dc26c, 0x5cc863, 0x6ece58, 0x82d34d, 0x95d840, 0xaadc32, 0xc0df25, 0xd5e21a, 0xeae51a, 0xfde725};

static oklab from_polar(oklch p)
{
    const double h = p.h * acos(-1.0) / 180.0;
    return (oklab){p.l, p.c * cos(h), p.c * sin(h)};
}

static double cube_of(double x)
{
    return x * x * x;
}

/* A component of linear light as a byte of sRGB (IEC 61966-2-1). */
static uint32_t srgb_byte(double x)
{
    const double v = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
    return (uint32_t)lround(255.0 * fmin(1.0, fmax(0.0, v)));
}

static uint32_t srgb_of_oklab(oklab k)
{
    const double l = cube_of(k.l + 0.3963377774 * k.a + 0.2158037573 * k.b);
    const double m = cube_of(k.l - 0.1055613458 * k.a - 0.0638541728 * k.b);
    const double s = cube_of(k.l - 0.0894841775 * k.a - 1.2914855480 * k.b);
    return srgb_byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s) << 16 |
           srgb_byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s) << 8 |
           srgb_byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s);
}

/* Lightness is linear along the curve, the hue bends. */
static uint32_t on_arc(const arc *curve, double t)
{
    const oklab p = from_polar(curve->from), q = from_polar(curve->by), r = from_polar(curve->to);
    const double u = (1.0 - t) * (1.0 - t), v = 2.0 * t * (1.0 - t), w = t * t;
    return srgb_of_oklab((oklab){p.l + (r.l - p.l) * t, u * p.a + v * q.a + w * r.a, u * p.b + v * q.b + w * r.b});
}

static uint32_t blend_colours(uint32_t a, uint32_t b, double t)
{
    uint32_t mixed = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        const double low = a >> shift & 255, high = b >> shift & 255;
        mixed |= (uint32_t)lround(low + (high - low) * t) << shift;
    }
    return mixed;
}

static uint32_t in_viridis(double t)
{
    const int i = (int)fmin(31.0, 32.0 * t);
    return blend_colours(viridis[i], viridis[i + 1], 32.0 * t - i);
}

static uint32_t make_colour(colour_kind kind, bool dark, double t)
{
    switch (kind) {
    case COLOUR_WARM: return on_arc(&warm[dark], t);
    case COLOUR_COOL: return on_arc(&cool[dark], t);
    case COLOUR_GREY: return on_arc(&grey[dark], t);
    case COLOUR_SIGNED: return t < 0.5 ? on_arc(&below_zero[dark], 2.0 * t) : on_arc(&above_zero[dark], 2.0 * t - 1.0);
    case COLOUR_SINGLE: break;
    }
    return in_viridis(t);
}

void colour_map_make(colour_map *map, colour_kind kind, bool dark)
{
    for (int i = 0; i < COLOUR_STEPS; i++) map->rgb[i] = make_colour(kind, dark, i / (COLOUR_STEPS - 1.0));
}

uint32_t colour_of(const colour_map *map, double t)
{
    return map->rgb[(int)lround((COLOUR_STEPS - 1) * fmin(1.0, fmax(0.0, t)))];
}
