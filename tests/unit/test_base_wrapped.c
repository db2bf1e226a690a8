/* Messages on a terminal are broken between words; elsewhere they are as they come. */
#include "check.h"

#include "base/wrapped.h"

#include <stdio.h>
#include <string.h>

static void check_wrapped(const char *text, int width, const char *wanted)
{
    char found[512] = "";
    FILE *file = tmpfile();
    assert_non_null(file);
    wrapped_print(file, text, width);
    rewind(file);
    const size_t length = fread(found, 1, sizeof found - 1, file);
    found[length] = '\0';
    (void)fclose(file);
    assert_string_equal(found, wanted);
}

static void long_lines_go_on_further_in(void **state)
{
    (void)state;
    check_wrapped("one two three four\n", 13, "one two three\n    four\n");
    check_wrapped("  one two three four", 13, "  one two\n      three\n      four");
    check_wrapped("short\nand one two three\n", 13, "short\nand one two\n    three\n");
    check_wrapped("one two three four\n", 0, "one two three four\n");
    check_wrapped("", 13, "");
}

static void words_and_shares_stay_whole(void **state)
{
    (void)state;
    check_wrapped("see /a/path/that/is/long and more", 13, "see\n    /a/path/that/is/long\n    and more");
    check_wrapped("/a/path/that/is/long and more", 13, "/a/path/that/is/long\n    and more");
    check_wrapped("three times 2 % off", 14, "three times\n    2 % off");
}

/* A character of UTF-8 is one column, an escape of colour none. */
static void columns_are_counted_as_they_are_seen(void **state)
{
    (void)state;
    check_wrapped("\xc3\xa4\xc3\xb6\xc3\xbc \xc3\xa4\xc3\xb6\xc3\xbc \xc3\xa4\xc3\xb6\xc3\xbc\xc3\xa4\xc3\xb6", 13,
                  "\xc3\xa4\xc3\xb6\xc3\xbc \xc3\xa4\xc3\xb6\xc3\xbc \xc3\xa4\xc3\xb6\xc3\xbc\xc3\xa4\xc3\xb6");
    check_wrapped("\033[1;31merror:\033[0m one two", 14, "\033[1;31merror:\033[0m one two");
    check_wrapped("\033[1;31merror:\033[0m one two", 13, "\033[1;31merror:\033[0m one\n    two");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(long_lines_go_on_further_in),
                                       cmocka_unit_test(words_and_shares_stay_whole),
                                       cmocka_unit_test(columns_are_counted_as_they_are_seen)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
