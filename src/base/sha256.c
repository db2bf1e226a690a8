#include "base/sha256.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <stdio.h>

static bool digest_parts(EVP_MD_CTX *h, const sha256_part *part, size_t n, unsigned char digest[SHA256_SIZE])
{
    if (EVP_DigestInit_ex(h, EVP_sha256(), NULL) != 1) return false;
    for (size_t k = 0; k < n; ++k)
        if (EVP_DigestUpdate(h, part[k].data, part[k].size) != 1) return false;
    return EVP_DigestFinal_ex(h, digest, NULL) == 1;
}

floe_status sha256_of_parts(context *ctx, const sha256_part *part, size_t n, unsigned char digest[SHA256_SIZE])
{
    OPENSSL_init_crypto(OPENSSL_INIT_NO_LOAD_CONFIG, NULL); /* its settings are not for a checksum */
    EVP_MD_CTX *h = EVP_MD_CTX_new();
    const bool done = h && digest_parts(h, part, n, digest);
    EVP_MD_CTX_free(h);
    return done ? FLOE_OK : fail(ctx, FLOE_NO_MEMORY, "no memory for a checksum");
}

floe_status sha256_of(context *ctx, const void *data, size_t size, char hex[SHA256_TEXT])
{
    unsigned char digest[SHA256_SIZE];
    hex[0] = '\0';
    TRY(sha256_of_parts(ctx, &(sha256_part){data, size}, 1, digest));
    for (int i = 0; i < SHA256_SIZE; i++) (void)snprintf(hex + 2 * (size_t)i, 3, "%02x", digest[i]);
    return FLOE_OK;
}
