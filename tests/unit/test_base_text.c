/* Texts of a fixed size: what does not fit is left out, and nothing is written behind them. */
#include "check.h"

#include "base/text.h"

#include <string.h>

static void texts_are_cut_where_they_end(void **state)
{
    (void)state;
    char text[16] = "";
    memset(text + 8, '#', 8);
    text_add(text, 8, "%s", "abc");
    text_add(text, 8, "-%d", 12);
    assert_string_equal(text, "abc-12");
    text_add(text, 8, "%s", "xyz");
    assert_string_equal(text, "abc-12x");
    text_add(text, 8, "%s", "more");
    assert_string_equal(text, "abc-12x");
    for (int k = 8; k < 16; ++k) assert_int_equal(text[k], '#');
    memset(text, '#', 16); /* no end: nothing is added */
    text_add(text, 8, "a");
    for (int k = 0; k < 16; ++k) assert_int_equal(text[k], '#');
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(texts_are_cut_where_they_end)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
