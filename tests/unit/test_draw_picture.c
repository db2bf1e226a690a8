/* Pictures: colour maps whose lightness tells the order; PNG files whose pixels have the colour of the value that is there. */
#include "check.h"

#include "base/memory.h"
#include "draw/colour_scale.h"
#include "draw/picture.h"
#include "io/file.h"

#include <cairo.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* CIE lightness L* of a colour (CIE 15:2004), 0 to 100. */
static double lightness(uint32_t rgb)
{
    const double weight[] = {0.2126, 0.7152, 0.0722};
    double y = 0.0;
    for (int i = 0; i < 3; i++) {
        const double v = (rgb >> (16 - 8 * i) & 255) / 255.0;
        y += weight[i] * (v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
    }
    return y > 216.0 / 24389.0 ? 116.0 * cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

/* Lightness is one-to-one with the value (for signed ones with its size), over a wide range. */
static void colours_keep_the_order(void **state)
{
    (void)state;
    for (int kind = COLOUR_SINGLE; kind <= COLOUR_SIGNED; kind++) {
        for (int dark = 0; dark < 2; dark++) {
            colour_map m;
            colour_map_make(&m, (colour_kind)kind, dark != 0);
            const int first = kind == COLOUR_SIGNED ? 128 : 0;
            const double sign = lightness(m.rgb[255]) > lightness(m.rgb[first]) ? 1.0 : -1.0;
            assert_true(fabs(lightness(m.rgb[255]) - lightness(m.rgb[first])) > 45.0);
            for (int i = first; i + 8 < 256; i++) {
                check_true(sign * (lightness(m.rgb[i + 8]) - lightness(m.rgb[i])) > 0.8);
            }
            for (int i = 0; kind == COLOUR_SIGNED && i < 128; i += 8) { /* both signs weigh the same */
                check_close(lightness(m.rgb[i]), lightness(m.rgb[255 - i]), 6.0);
            }
        }
    }
    colour_map m;
    colour_map_make(&m, COLOUR_SINGLE, false);
    assert_int_equal(m.rgb[0], 0x440154); /* viridis, as published */
    assert_int_equal(m.rgb[255], 0xfde725);
    assert_int_equal(colour_of(&m, -3.0), m.rgb[0]);
    assert_int_equal(colour_of(&m, 7.0), m.rgb[255]);
}

enum { CELLS_X = 4, CELLS_Y = 2 };

static const double cell_value[CELLS_X * CELLS_Y] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};

static picture plain_picture(const picture_cells *cells)
{
    return (picture){.dim = 2,
                     .title = "A picture",
                     .time = 1e-3,
                     .time_unit = "s",
                     .axis = {"x", "y"},
                     .unit = "m",
                     .upper = {2.0, 1.0},
                     .scale = {{.label = "pressure", .unit = "Pa", .lower = 0.0, .upper = 7.0}},
                     .n_scales = 1,
                     .cells = cells};
}

static const picture_cells plain_cells = {.n = {CELLS_X, CELLS_Y}, .spacing = {0.5, 0.5}, .value = cell_value};

typedef struct folder {
    context *ctx;
    char dir[128], path[160];
} folder;

static folder open_folder(void)
{
    folder f = {.ctx = context_create()};
    const char *base = getenv("TMPDIR");
    (void)snprintf(f.dir, sizeof f.dir, "%s/floe_draw_XXXXXX", base ? base : "/tmp");
    assert_non_null(mkdtemp(f.dir));
    (void)snprintf(f.path, sizeof f.path, "%s/a.png", f.dir);
    return f;
}

static void close_folder(folder *f)
{
    (void)unlink(f->path);
    assert_int_equal(rmdir(f->dir), 0); /* nothing half made is left */
    assert_int_equal(memory_read_account(f->ctx).live_bytes, 0);
    context_destroy(&f->ctx);
}

static cairo_surface_t *write_and_read(folder *f, const picture *p)
{
    check_ok(f->ctx, picture_write(f->ctx, f->path, p));
    cairo_surface_t *image = cairo_image_surface_create_from_png(f->path);
    assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
    assert_int_equal(cairo_image_surface_get_width(image), p->width > 0 ? p->width : PICTURE_WIDTH);
    return image;
}

static uint32_t pixel(cairo_surface_t *image, int x, int y)
{
    const unsigned char *row =
        cairo_image_surface_get_data(image) + (ptrdiff_t)y * cairo_image_surface_get_stride(image);
    uint32_t rgb;
    memcpy(&rgb, row + 4 * (ptrdiff_t)x, sizeof rgb);
    return rgb & 0xffffff;
}

/* Pixels of that very colour, and the box that holds them. */
typedef struct patch {
    int n, left, right, top, bottom;
} patch;

static patch find(cairo_surface_t *image, uint32_t rgb, int from, int to)
{
    patch p = {.left = 1 << 20, .top = 1 << 20};
    for (int y = from; y < to; y++) {
        for (int x = 0; x < cairo_image_surface_get_width(image); x++) {
            if (pixel(image, x, y) != rgb) continue;
            p.n++;
            if (x < p.left) p.left = x;
            if (x > p.right) p.right = x;
            if (y < p.top) p.top = y;
            if (y > p.bottom) p.bottom = y;
        }
    }
    return p;
}

/* Each cell is a rectangle of its colour, in its place, as wide as high. */
static void cells_have_their_colours(void **state)
{
    (void)state;
    folder f = open_folder();
    colour_map m;
    colour_map_make(&m, COLOUR_SINGLE, false);
    const picture p = plain_picture(&plain_cells);
    cairo_surface_t *image = write_and_read(&f, &p);
    const int field = cairo_image_surface_get_height(image) - 200; /* the colour bar is below */
    const patch first = find(image, colour_of(&m, 0.0), 0, field);
    for (int j = 0; j < CELLS_Y; j++) {
        for (int i = 0; i < CELLS_X; i++) {
            const patch cell = find(image, colour_of(&m, cell_value[CELLS_X * j + i] / 7.0), 0, field);
            const int width = cell.right - cell.left + 1, height = cell.bottom - cell.top + 1;
            assert_in_range(width, 140, 165);
            assert_in_range(height, width - 4, width + 4);
            assert_in_range(cell.n, 0.95 * width * height, width * height);
            assert_in_range(cell.left, first.left + i * width - 5, first.left + i * width + 5);
            assert_in_range(cell.top, first.top - j * height - 5, first.top - j * height + 5); /* y points up */
        }
    }
    cairo_surface_destroy(image);
    close_folder(&f);
}

/* A point covers the area that it has; one without value is grey; a cell without value shows the paper. */
static void points_have_size_and_colour(void **state)
{
    (void)state;
    const double x[] = {0.5, 0.5, 1.5, 0.5}, edge[] = {0.2, 0.2}, value[] = {7.0, NAN};
    const double none[CELLS_X * CELLS_Y] = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    const picture_points points = {.name = "a", .n = 2, .x = x, .edge = edge, .value = value};
    picture_cells cells = plain_cells;
    cells.value = none;
    for (int dark = 0; dark < 2; dark++) {
        folder f = open_folder();
        colour_map m;
        colour_map_make(&m, COLOUR_SINGLE, dark != 0);
        picture p = plain_picture(&cells);
        p.points = &points;
        p.n_points = 1;
        p.dark = dark != 0;
        cairo_surface_t *image = write_and_read(&f, &p);
        const int field = cairo_image_surface_get_height(image) - 200;
        const patch full = find(image, m.rgb[255], 0, field);
        const patch grey = find(image, dark ? 0x7d8590 : 0x9aa2ac, 0, field);
        assert_in_range(full.right - full.left + 1, 58, 68); /* 0.2 of 2 m, of some 610 px */
        assert_in_range(full.bottom - full.top + 1, 58, 68);
        assert_int_equal(grey.right - grey.left, full.right - full.left);
        assert_in_range(grey.left - full.left, 295, 320);
        assert_int_equal(pixel(image, (full.left + grey.left) / 2, full.top), dark ? 0x15181d : 0xffffff);
        cairo_surface_destroy(image);
        close_folder(&f);
    }
}

/* The same picture, twice as large: the proportions stay. */
static void width_scales_everything(void **state)
{
    (void)state;
    int height[2];
    for (int i = 0; i < 2; i++) {
        folder f = open_folder();
        picture p = plain_picture(&plain_cells);
        p.width = i == 0 ? 400 : 1600;
        cairo_surface_t *image = write_and_read(&f, &p);
        height[i] = cairo_image_surface_get_height(image);
        cairo_surface_destroy(image);
        close_folder(&f);
    }
    assert_in_range(height[1], 4 * height[0] - 4, 4 * height[0] + 4);
}

/* Nothing, one cell, all NaN, infinite values, a thread of a domain, points far outside, long texts: all of them give a picture. */
static void odd_pictures_are_drawn(void **state)
{
    (void)state;
    const double x[] = {NAN, 0.5, 1e300, -1e300, 0.5, 0.5}, edge[] = {0.1, INFINITY, 0.0},
                 value[] = {1.0, INFINITY, -INFINITY};
    const double one[] = {3.0};
    const picture_points points = {.name = "a", .n = 3, .x = x, .edge = edge, .value = value};
    const picture_points blank = {.name = "b"};
    const picture_cells cell = {.n = {1, 1}, .spacing = {2.0, 1.0}, .value = one};
    const picture_cells nothing = {.n = {0, 0}, .spacing = {1.0, 1.0}};
    char text[3000];
    memset(text, 'W', sizeof text);
    text[sizeof text - 1] = '\0';
    for (int n = 0; n < 16; n++) {
        folder f = open_folder();
        picture p = plain_picture(n % 2 ? &cell : &nothing);
        p.dim = n < 8 ? 2 : 1;
        p.points = n % 3 ? &points : &blank;
        p.n_points = 1;
        p.n_scales = n % 5 == 0 ? 0 : 1 + n % 2;
        p.scale[0].lower = p.scale[0].upper = 0.0;
        p.scale[1] = (picture_scale){.label = text, .unit = text, .about_zero = true};
        p.title = n % 4 ? text : NULL;
        p.note = n % 2 ? text : NULL;
        if (n % 3 == 0) p.time = NAN;
        if (n % 4 == 1) p.upper[1] = 1e-6;
        if (n % 4 == 2) p.upper[0] = 1e-6;
        cairo_surface_destroy(write_and_read(&f, &p));
        close_folder(&f);
    }
}

/* The profile shows the cells' line within its frame. */
static void profiles_show_curves(void **state)
{
    (void)state;
    folder f = open_folder();
    const double x[] = {0.25, 0.0, 1.75, 0.0}, value[] = {1.0, 6.0};
    const picture_points points = {.name = "a", .n = 2, .x = x, .value = value};
    picture_cells cells = plain_cells;
    cells.n[1] = 1;
    picture p = plain_picture(&cells);
    p.dim = 1;
    p.points = &points;
    p.n_points = 1;
    cairo_surface_t *image = write_and_read(&f, &p);
    const patch line = find(image, 0x0072b2, 200, cairo_image_surface_get_height(image));
    const patch dots = find(image, 0xd55e00, 200, cairo_image_surface_get_height(image));
    assert_true(line.n > 1000 && dots.n > 40);
    assert_true(line.right - line.left > 550);                         /* from end to end */
    assert_in_range(dots.right - dots.left, 440, 500);                 /* three quarters of it */
    assert_true(dots.bottom - dots.top > line.bottom - line.top + 80); /* 1 to 6, over 0 to 3 */
    cairo_surface_destroy(image);
    close_folder(&f);
}

static void failures_leave_nothing(void **state)
{
    (void)state;
    folder f = open_folder();
    const picture p = plain_picture(&plain_cells);
    check_fails(f.ctx, picture_write(f.ctx, "/no/such/folder/a.png", &p), FLOE_IO);
    check_ok(f.ctx, file_replace_text(f.ctx, f.path, "earlier"));
    int failed = 0;
    for (uint64_t n = 1; n <= 4; n++) {
        memory_inject_failure(f.ctx, n);
        const floe_status status = picture_write(f.ctx, f.path, &p);
        memory_inject_failure(f.ctx, 0);
        if (status == FLOE_OK) break;
        check_fails(f.ctx, status, FLOE_NO_MEMORY);
        failed++;
    }
    assert_true(failed >= 2);
    close_folder(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colours_keep_the_order),      cmocka_unit_test(cells_have_their_colours),
        cmocka_unit_test(points_have_size_and_colour), cmocka_unit_test(width_scales_everything),
        cmocka_unit_test(odd_pictures_are_drawn),      cmocka_unit_test(profiles_show_curves),
        cmocka_unit_test(failures_leave_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
