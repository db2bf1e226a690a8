/* Points across solids that bend (theory 4.7): which get more by default. */
#include "mpm_fixture.h"

#include "scene/slender.h"

typedef struct slab {
    double lower[2], upper[2]; /* in cells, of a domain of 40 x 40 */
    int along, across;         /* points a cell that it gets */
} slab;

static void test_who_gets_more(void **state)
{
    static const slab slabs[] = {
        {{5, 10}, {35, 12}, 2, 4}, {{5, 10.3}, {35, 14.3}, 2, 4},
        {{0, 10}, {35, 12}, 2, 4},                            /* beams, one clamped at its end */
        {{5, 10}, {35, 15}, 2, 2},                            /* ten points across already */
        {{5, 10}, {13, 12}, 2, 2},                            /* a block */
        {{5, 0}, {35, 2}, 2, 2},   {{0, 10}, {40, 12}, 2, 2}, /* on a side; from side to side */
    };
    (void)state;
    for (size_t k = 0; k < sizeof slabs / sizeof *slabs; ++k) {
        const double size[3] = {40.0, 40.0, 0.0};
        trial t;
        trial_begin(&t, 2, size, 1.0);
        const int solid = add_solid(&t, "linear_elastic", 0.6, 0.3, 1.0);
        const double lo[3] = {slabs[k].lower[0], slabs[k].lower[1], 0},
                     hi[3] = {slabs[k].upper[0], slabs[k].upper[1], 1};
        scene_body *b = add_body(&t, solid, make_box(&t, lo, hi), 2);
        slender_seed(t.scene, b);
        assert_int_equal(b->per_cell[0], slabs[k].along);
        assert_int_equal(b->per_cell[1], slabs[k].across);
        trial_end(&t);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_who_gets_more),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
