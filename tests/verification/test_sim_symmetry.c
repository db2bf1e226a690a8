/* Scenes that are one scene in theory are one in their results: mirrored, with axes exchanged, moved by whole cells, with bodies or
 * materials in another order, a body told as two, a fluid more of which there is nothing, a plane scene as a slab of one cell and a line as a strip. Every deck
 * of inputs/ is asked, and a few in every way (nightly all, for more steps); what differs beyond round-off is a fault, or is named here with its reason. */
#include "metamorphic_fixture.h"
#include "transformed_scenes_fixture.h"

static const struct {
    const char *name;
    transform_scene *make;
} change[] = {
    {"mirror x", mirror_x},       {"mirror y", mirror_y},  {"mirror z", mirror_z},        {"swap", swap_axes},
    {"move", move_all},           {"bodies", turn_bodies}, {"materials", turn_materials}, {"split", split_body},
    {"absent fluid", add_absent}, {"slab", thicken},
};

/* Round-off of a step, and of so many: sums in another order. The most that was measured on decks without a name here is 8e-13. */
static const double round_off_start = 1e-12, round_off = 1e-11;

static const char sliver_ties[] =
    "a sliver joins the larger neighbour, of two alike either; nodes that bear next to nothing";
static const char half_open[] = "a cell that is open by just half has its own state or its neighbour's";
static const char within_one_body[] =
    "lines of the edge penalty lie within one body: two halves have others than the whole";
static const char edges_to_1_percent[] =
    "accelerations at edges are solved for to 1 %: sums in another order end elsewhere";
static const char chain_thinned[] =
    "of two markers of a surface that are too close together the later one of the chain goes";

/* What differs by more. `seeding`: points may not be the same either. */
static const struct {
    const char *change, *deck; /* beginnings of their names */
    double most;
    bool seeding;
    const char *why;
} known[] = {
    {"", "annulus_traction", 1e-5, true, sliver_ties},
    {"", "pressurized_", 1e-5, true, sliver_ties},
    {"", "extreme/vessel", 1e-5, true, sliver_ties},
    {"", "extreme/courant_disc", 1e-5, true, sliver_ties},
    {"", "membrane_circle", 1e-5, true, sliver_ties},
    {"", "extreme/load_at_once", 1e-5, true, sliver_ties},
    {"", "stiff_cylinder", 1e-5, true, sliver_ties},
    {"", "extreme/crumpled_points", 1e-5, true, sliver_ties},
    {"", "cylinder_channel", 1e-2, true,
     "a sliver joins the larger neighbour, of two alike either; a side that ends in a corner has it or the next one "
     "does"},
    {"", "turek_hron_cfd", 1e-2, true,
     "a sliver joins the larger neighbour, of two alike either; points on its edge are the body's or not"},
    {"", "natural_convection", 5e-3, true,
     "gas under gravity keeps the pressure of its highest cell, a sliver or not; walls keep their temperatures to "
     "1e-7"},
    {"", "turek_hron_fsi", 1e-2, true,
     "a sliver joins the larger neighbour, of two alike either; points on its edge are the body's or not"},
    {"swap", "extreme/soft_vessel", 1e-5, true, sliver_ties},
    {"move", "extreme/soft_vessel", 1e-5, true, sliver_ties},
    {"mirror", "extreme/soft_vessel", 2e-5, false, chain_thinned},
    {"", "pressed_cylinder", 1e-7, false, "balance is solved for to a tolerance"},
    {"slab", "fluid_", 6e-4, false,
     "an interface has the steepness 2.3 along a line, and 2.31 along an axis of a plane"},
    {"slab", "extreme/impact", 3e-4, false, "points reach as far as the root of their area, in a strip farther"},
    {"slab", "turek_hron_csm", 6e-9, false, "balance is solved for to a tolerance"},
    {"split", "extreme/leaving", 1.7, false, within_one_body},
    {"split", "extreme/places_3d", 0.2, false, within_one_body},
    {"split", "extreme/torn", 3e-4, false, within_one_body},
    {"split", "extreme/walls", 0.04, false, within_one_body},
    {"split", "taylor_bar", 3e-4, false, within_one_body},
    {"slab", "extreme/leaving", 256.0, false,
     "gradients that points carry across a slab are round-off times the square of its depth over that of a cell"},
    {"", "extreme/leaving", 2e-3, false, edges_to_1_percent},
    {"slab", "extreme/torn", 2e-5, false, edges_to_1_percent},
    {"slab", "extreme/walls", 0.02, false, edges_to_1_percent},
    {"mirror", "slip_wall", 8e-4, false, edges_to_1_percent},
    {"mirror", "extreme/slam", 8e-4, false, half_open},
    {"mirror", "water_impact", 8e-4, false, half_open},
    {"materials", "extreme/volume_fraction", 1.0, false,
     "a cell that is just half full is on either side of an interface"},
    {"mirror", "two_bags", 4e-11, false, "round-off over the small openings of cells that membranes cut"},
    {"materials", "two_bags", 1e-4, false,
     "the pressure of a cell that a line cuts is shown of the fluid that is first"},
    {"materials", "airbag_inflator", 1e-5, false,
     "the pressure of a cell that a line cuts is shown of the fluid that is first"},
    {"mirror", "foam_wall", 0.02, false, sliver_ties},
    {"swap", "foam_wall", 0.3, false, sliver_ties},
    {"materials", "extreme/crumpled", 1e-4, false,
     "the pressure of a cell that a line cuts is shown of the fluid that is first"},
    {"", "membrane_dogbone", 1.0, false, half_open},
    {"swap", "two_bags", 4e-4, false, "a small cell takes the state of the roomier neighbour, on a diagonal of either"},
    {"move", "two_bags", 4e-4, false, "a small cell takes the state of the roomier neighbour, on a diagonal of either"},
    {"swap", "extreme/crumpled", 0.1, false,
     "a small cell takes the state of the roomier neighbour, on a diagonal of either"},
    {"swap", "lid_cavity", 0.1, false, "the corner of a wall and a lid moves as the side of the last axis does"},
    {"move", "two_bags", 1e-5, false, "a small cell takes the state of the roomier neighbour, by round-off of either"},
};

/* How often each reason has been needed, and how much of it: of runs whose points are the same. */
static struct {
    long runs;
    double worst;
} needed[sizeof known / sizeof *known];

/* The implicit pressure is solved for to a tolerance. */
static const double implicit_most = 1e-5;

static bool begins(const char *text, const char *how)
{
    return strncmp(text, how, strlen(how)) == 0;
}

/* The index of the reason, -1: none. */
static int reason_of(const char *what, const subject *s)
{
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k)
        if (begins(what, known[k].change) && begins(s->deck, known[k].deck)) return (int)k;
    return -1;
}

/* A scene at the start and after its steps. */
typedef struct course {
    holding start, end;
    bool done;
} course;

static void course_run(subject *s, long steps, course *out)
{
    out->start = hold(s->t.sim);
    out->done = subject_steps(s, steps);
    out->end = hold(s->t.sim);
    out->start.speed = out->end.speed; /* before the first step none is known */
    out->start.step = out->end.step;
}

static void course_free(course *c)
{
    holding_free(&c->start);
    holding_free(&c->end);
}

static void judge(const char *what, const subject *s, bool matched, const apart *start, const apart *end, tally *count)
{
    const int why = reason_of(what, s);
    const bool implicit = s->t.scene->method.pressure != PRESSURE_EXPLICIT;
    const double most = fmax(why < 0 ? 0.0 : known[why].most, implicit ? implicit_most : 0.0);
    count->runs++;
    if (matched && start->worst <= round_off_start && end->worst <= round_off) {
        count->same++;
    } else if (matched ? fmax(start->worst, end->worst) <= most : why >= 0 && known[why].seeding) {
        count->known++;
        if (why < 0) return;
        needed[why].runs++;
        if (matched) needed[why].worst = fmax(needed[why].worst, fmax(start->worst, end->worst));
    } else {
        count->wrong++;
        print_error("%s, %s: %s, %.2g of '%s' at the start, %.2g of '%s' after\n", subject_name(s), what,
                    matched ? "apart" : "other points", start->worst, start->field ? start->field : "", end->worst,
                    end->field ? end->field : "");
    }
}

static void compare_courses(const char *what, const subject *s, const transformation *k, const course *first,
                            const course *transformed, tally *count)
{
    size_t *points = malloc((transformed->start.points + 1) * sizeof *points);
    size_t *cells = malloc((transformed->start.cells + 1) * sizeof *cells);
    const double reach = 1e-6 * s->t.scene->mesh.cell[0];
    const bool matched = match_points(&first->start, &transformed->start, k, reach, points);
    apart start = {0}, end = {0};
    match_cells(&first->start, &transformed->start, k, cells);
    if (matched) start = holdings_apart(&first->start, &transformed->start, k, points, cells);
    const bool kept = first->end.points == first->start.points && transformed->end.points == transformed->start.points;
    if (matched && kept) end = holdings_apart(&first->end, &transformed->end, k, points, cells);
    if (first->done != transformed->done || !kept) end = (apart){(double)INFINITY, "steps"};
    judge(what, s, matched, &start, &end, count);
    free(points);
    free(cells);
}

/* Surfaces in space have their points in bands about an axis, and no map is made of them here. */
static bool has_sheets(const scene *s)
{
    for (int b = 0; b < s->n_bodies; ++b)
        if (s->body[b].membrane.surface.kind != SHEET_NONE) return true;
    return false;
}

static void check_change(subject *s, size_t which, long steps, const course *first, tally *count)
{
    assert_true(subject_load(s) && subject_attach(s));
    transformation k = {.map = map_none(s->t.scene->mesh.dim), .depth = 1.0};
    for (int i = 0; i < SCENE_MAX_MATERIALS; ++i) k.material[i] = i;
    if (!has_sheets(s->t.scene) && change[which].make(s->t.scene, &k)) {
        check_ok(s->t.ctx, sim_create(&s->t.sim, s->t.ctx, s->t.scene, s->coupling));
        course transformed;
        course_run(s, steps, &transformed);
        compare_courses(change[which].name, s, &k, first, &transformed, count);
        course_free(&transformed);
    }
    subject_end(s);
}

/* Decks that take a third of the time of all, and whose differences have names as it is. */
static bool is_nightly(const char *deck)
{
    static const char *const nightly[] = {"cylinder_channel", "extreme/soft_vessel", "membrane_dogbone",
                                          "turek_hron_csm", "two_bags"};
    for (size_t k = 0; k < sizeof nightly / sizeof *nightly; ++k)
        if (strcmp(deck, nightly[k]) == 0) return !check_at_length();
    return false;
}

static void check_transformed(subject *s, void *user, tally *count)
{
    const long steps = *(const long *)user;
    course first;
    if (is_nightly(s->deck)) return;
    assert_true(subject_load(s) && subject_start(s));
    course_run(s, steps, &first);
    subject_end(s);
    for (size_t c = 0; c < sizeof change / sizeof *change; ++c) check_change(s, c, steps, &first, count);
    course_free(&first);
}

static void test_symmetry(void **unused)
{
    (void)unused;
    long steps = check_at_length() ? 20 : 6;
    tally count = {0};
    check_decks(!check_at_length(), check_transformed, &steps, &count);
    print_tally("symmetry", &count);
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k)
        if (needed[k].runs > 0)
            print_message("%ld of %s%s%s, by %.0e at most: %s\n", needed[k].runs, known[k].deck,
                          known[k].change[0] ? ", " : "", known[k].change, needed[k].worst, known[k].why);
    assert_int_equal(count.wrong, 0);
    check_true(count.same > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_symmetry)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
