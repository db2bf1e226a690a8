/* The checksum. */
#include "base/sha256.h"
#include "check.h"

#include <string.h>

/* The examples of FIPS 180-4 and its addenda. */
static void checksum_is_sha256(void **state)
{
    (void)state;
    char hex[SHA256_TEXT];
    static char million[1000001];
    sha256_of_text("", hex);
    assert_string_equal(hex, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    sha256_of_text("abc", hex);
    assert_string_equal(hex, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    sha256_of_text("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", hex);
    assert_string_equal(hex, "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    memset(million, 'a', 1000000);
    sha256_of_text(million, hex);
    assert_string_equal(hex, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

/* In pieces or at once: the same. */
static void checksum_does_not_see_pieces(void **state)
{
    (void)state;
    unsigned char data[300], whole[SHA256_SIZE], parts[SHA256_SIZE];
    for (size_t i = 0; i < sizeof data; i++) data[i] = (unsigned char)(i * 7);
    for (size_t n = 0; n < sizeof data; n++) {
        sha256 a, b;
        sha256_begin(&a);
        sha256_add(&a, data, n);
        sha256_end(&a, whole);
        sha256_begin(&b);
        for (size_t i = 0; i < n; i += 13) sha256_add(&b, data + i, n - i < 13 ? n - i : 13);
        sha256_end(&b, parts);
        assert_memory_equal(whole, parts, SHA256_SIZE);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(checksum_is_sha256),
        cmocka_unit_test(checksum_does_not_see_pieces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
