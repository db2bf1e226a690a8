/* Texts that grow: escapes and encodings against their definitions. */
#include "check.h"

#include "base/memory.h"
#include "base/strbuf.h"

#include <string.h>

static int set_up(void **state)
{
    *state = context_create();
    return *state ? 0 : -1;
}

static int tear_down(void **state)
{
    context *ctx = *state;
    context_destroy(&ctx);
    return 0;
}

static void fields_and_markup_are_escaped(void **state)
{
    strbuf t;
    strbuf_init(&t, *state);
    strbuf_append_csv(&t, "a \"b\", c\nd");
    assert_string_equal(strbuf_string(&t), "\"a \"\"b\"\", c d\"");
    strbuf_free(&t);
    strbuf_append_xml(&t, "<a b='c'>&\"\n");
    assert_string_equal(strbuf_string(&t), "&lt;a b=&apos;c&apos;&gt;&amp;&quot; ");
    strbuf_free(&t);
}

/* A text is handed over whole, an empty one too, and the buffer can be used again. */
static void a_text_is_handed_over(void **state)
{
    context *ctx = *state;
    strbuf t = {.ctx = ctx};
    char *text;
    strbuf_append_bytes(&t, "ab%sc", 4);
    strbuf_append(&t, "%d", 7);
    check_ok(ctx, strbuf_take(&t, &text));
    assert_string_equal(text, "ab%s7");
    memory_free(ctx, &text);
    assert_int_equal(t.length, 0);
    check_ok(ctx, strbuf_take(&t, &text));
    assert_string_equal(text, "");
    memory_free(ctx, &text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(fields_and_markup_are_escaped, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_text_is_handed_over, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
