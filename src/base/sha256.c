#include "base/sha256.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <stdio.h>

static floe_status after_step(sha256 *sum, int done)
{
    if (done == 1) return FLOE_OK;
    sha256_abandon(sum);
    return fail(sum->ctx, FLOE_NO_MEMORY, "no memory for a checksum");
}

floe_status sha256_begin(sha256 *sum, context *ctx)
{
    OPENSSL_init_crypto(OPENSSL_INIT_NO_LOAD_CONFIG, NULL); /* its settings are not for a checksum */
    *sum = (sha256){ctx, EVP_MD_CTX_new()};
    return after_step(sum, sum->state ? EVP_DigestInit_ex(sum->state, EVP_sha256(), NULL) : 0);
}

floe_status sha256_add(sha256 *sum, const void *data, size_t size)
{
    return after_step(sum, EVP_DigestUpdate(sum->state, data, size));
}

floe_status sha256_finish(sha256 *sum, unsigned char digest[SHA256_SIZE])
{
    TRY(after_step(sum, EVP_DigestFinal_ex(sum->state, digest, NULL)));
    sha256_abandon(sum);
    return FLOE_OK;
}

void sha256_abandon(sha256 *sum)
{
    EVP_MD_CTX_free(sum->state);
    sum->state = NULL;
}

floe_status sha256_of_parts(context *ctx, const sha256_part *part, size_t n, unsigned char digest[SHA256_SIZE])
{
    sha256 sum;
    TRY(sha256_begin(&sum, ctx));
    for (size_t k = 0; k < n; ++k) TRY(sha256_add(&sum, part[k].data, part[k].size));
    return sha256_finish(&sum, digest);
}

floe_status sha256_of(context *ctx, const void *data, size_t size, char hex[SHA256_TEXT])
{
    unsigned char digest[SHA256_SIZE];
    hex[0] = '\0';
    TRY(sha256_of_parts(ctx, &(sha256_part){data, size}, 1, digest));
    for (int i = 0; i < SHA256_SIZE; i++) (void)snprintf(hex + 2 * (size_t)i, 3, "%02x", digest[i]);
    return FLOE_OK;
}
