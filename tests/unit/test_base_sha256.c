/* The checksum. */
#include "base/sha256.h"
#include "check.h"

#include <string.h>

static int setup(void **state)
{
    *state = context_create();
    return *state == NULL;
}

static int teardown(void **state)
{
    context *ctx = *state;
    context_destroy(&ctx);
    return 0;
}

static void check_digest(context *ctx, const char *text, size_t size, const char *expected)
{
    char hex[SHA256_TEXT];
    check_ok(ctx, sha256_of(ctx, text, size, hex));
    assert_string_equal(hex, expected);
}

/* The examples of FIPS 180-4 and its addenda. */
static void checksum_is_sha256(void **state)
{
    static char million[1000000];
    static const char two_blocks[] = "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
    context *ctx = *state;
    check_digest(ctx, "", 0, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    check_digest(ctx, "abc", 3, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    check_digest(ctx, two_blocks, strlen(two_blocks),
                 "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    memset(million, 'a', sizeof million);
    check_digest(ctx, million, sizeof million, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

/* In parts or at once: the same. */
static void checksum_does_not_see_parts(void **state)
{
    context *ctx = *state;
    unsigned char data[300], whole[SHA256_SIZE], digest[SHA256_SIZE];
    for (size_t i = 0; i < sizeof data; i++) data[i] = (unsigned char)(i * 7);
    for (size_t n = 0; n < sizeof data; n++) {
        const sha256_part one = {data, n}, parts[] = {{data, n / 3}, {data + n / 3, 0}, {data + n / 3, n - n / 3}};
        check_ok(ctx, sha256_of_parts(ctx, &one, 1, whole));
        check_ok(ctx, sha256_of_parts(ctx, parts, 3, digest));
        assert_memory_equal(whole, digest, SHA256_SIZE);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(checksum_is_sha256, setup, teardown),
        cmocka_unit_test_setup_teardown(checksum_does_not_see_parts, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
