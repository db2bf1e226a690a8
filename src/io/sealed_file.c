#include "io/sealed_file.h"

#include "base/memory.h"
#include "base/sha256.h"
#include "floe_build.h"
#include "io/file.h"

#include <inttypes.h>
#include <string.h>

enum {
    KIND_AT = 8,
    FORMAT_AT = 12,
    LENGTH_AT = 16,
    VERSION_AT = 24,
    VERSION_SIZE = 32,
    DIGEST_AT = SEALED_HEADER - SHA256_SIZE
};

static const unsigned char magic[8] = {0x89, 'f', 'l', 'o', 'e', '\r', '\n', 0x1a};

static const char *kind_name(uint64_t kind)
{
    if (kind == SEALED_CHECKPOINT) return "checkpoint";
    if (kind == SEALED_SNAPSHOT) return "snapshot";
    return "file of unknown kind";
}

static void put_number(unsigned char *at, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) at[i] = (unsigned char)(value >> (8 * i));
}

static uint64_t get_header_number(const unsigned char *at, int bytes)
{
    uint64_t value = 0;
    for (int i = 0; i < bytes; i++) value |= (uint64_t)at[i] << (8 * i);
    return value;
}

static floe_status digest_of(context *ctx, const unsigned char *header, const void *image, size_t size,
                             unsigned char digest[SHA256_SIZE])
{
    const sha256_part part[] = {{header, DIGEST_AT}, {image, size}};
    return sha256_of_parts(ctx, part, 2, digest);
}

/* Adds what has been written behind the header, piece by piece. */
static floe_status add_written(sha256 *sum, new_file *file, uint64_t size)
{
    enum { PIECE = 1 << 20 };
    char *piece;
    floe_status status = memory_new(file->ctx, &piece, PIECE, 1);
    for (uint64_t at = 0; status == FLOE_OK && at < size; at += PIECE) {
        const size_t bytes = size - at < PIECE ? (size_t)(size - at) : PIECE;
        if (!new_file_read(file, SEALED_HEADER + at, piece, bytes)) break; /* the file is told of it at its end */
        status = sha256_add(sum, piece, bytes);
    }
    memory_free(file->ctx, &piece);
    return status;
}

static floe_status digest_written(new_file *file, const unsigned char *header, uint64_t size,
                                  unsigned char digest[SHA256_SIZE])
{
    sha256 sum;
    TRY(sha256_begin(&sum, file->ctx));
    floe_status status = sha256_add(&sum, header, DIGEST_AT);
    if (status == FLOE_OK) status = add_written(&sum, file, size);
    if (status == FLOE_OK) return sha256_finish(&sum, digest);
    sha256_abandon(&sum);
    return status;
}

static floe_status write_header(new_file *file, sealed_kind kind, uint32_t format)
{
    _Static_assert(sizeof FLOE_VERSION <= VERSION_SIZE, "the version must fit its place in the header");
    unsigned char header[SEALED_HEADER] = {0};
    const uint64_t whole = new_file_size(file), size = whole < SEALED_HEADER ? 0 : whole - SEALED_HEADER;
    memcpy(header, magic, sizeof magic);
    put_number(header + KIND_AT, kind, 4);
    put_number(header + FORMAT_AT, format, 4);
    put_number(header + LENGTH_AT, size, 8);
    memcpy(header + VERSION_AT, FLOE_VERSION, sizeof FLOE_VERSION);
    TRY(digest_written(file, header, size, header + DIGEST_AT));
    new_file_write(file, 0, header, sizeof header);
    return FLOE_OK;
}

floe_status sealed_finish(new_file *file, floe_status so_far, sealed_kind kind, uint32_t format, const char *kept)
{
    const floe_status status = so_far == FLOE_OK ? write_header(file, kind, format) : so_far;
    return new_file_finish(file, status, kept);
}

/* The file is whole: it is what floe once wrote. */
static floe_status check_seal(context *ctx, const char *path, const unsigned char *data, size_t size)
{
    unsigned char digest[SHA256_SIZE];
    if (size < sizeof magic || memcmp(data, magic, sizeof magic) != 0) {
        return fail(ctx, FLOE_IO, "'%s' is not a file of floe's, or its first bytes are damaged", path);
    }
    if (size < SEALED_HEADER) {
        return fail(ctx, FLOE_IO, "'%s' is cut short: it ends within its header, at %zu bytes", path, size);
    }
    const uint64_t length = get_header_number(data + LENGTH_AT, 8);
    if (length != size - SEALED_HEADER) {
        return fail(ctx, FLOE_IO, "'%s' is %s: its header says that %" PRIu64 " bytes follow, but %zu do", path,
                    length > size - SEALED_HEADER ? "cut short" : "too long", length, size - SEALED_HEADER);
    }
    TRY(digest_of(ctx, data, data + SEALED_HEADER, size - SEALED_HEADER, digest));
    if (memcmp(digest, data + DIGEST_AT, SHA256_SIZE) != 0) {
        return fail(ctx, FLOE_IO, "'%s' is damaged: its checksum does not fit its content", path);
    }
    return FLOE_OK;
}

/* The file is what the caller asked for. */
static floe_status check_kind(context *ctx, const char *path, const unsigned char *data, sealed_kind kind,
                              uint32_t format, bool same_version)
{
    const uint64_t has_kind = get_header_number(data + KIND_AT, 4);
    const uint64_t has_format = get_header_number(data + FORMAT_AT, 4);
    char version[VERSION_SIZE + 1] = "";
    memcpy(version, data + VERSION_AT, VERSION_SIZE);
    if (has_kind != (uint64_t)kind) {
        return fail(ctx, FLOE_IO, "'%s' is a floe %s, not a %s", path, kind_name(has_kind), kind_name((uint64_t)kind));
    }
    if (has_format != format) {
        return fail(ctx, FLOE_IO,
                    "'%s' is a %s of format %" PRIu64 ", written by floe %s; this floe (%s) reads format %" PRIu32,
                    path, kind_name(has_kind), has_format, version, FLOE_VERSION, format);
    }
    if (same_version && strcmp(version, FLOE_VERSION) != 0) {
        return fail(
            ctx, FLOE_IO,
            "'%s' was written by floe %s and this is floe %s: bits might differ; resume with the version that wrote "
            "it, or start the run again",
            path, version, FLOE_VERSION);
    }
    return FLOE_OK;
}

floe_status sealed_read(context *ctx, const char *path, sealed_kind kind, uint32_t format, bool same_version,
                        sealed_file *out)
{
    size_t size;
    *out = (sealed_file){0};
    TRY(file_read(ctx, path, &out->data, &size));
    floe_status status = check_seal(ctx, path, (const unsigned char *)out->data, size);
    if (status == FLOE_OK) {
        status = check_kind(ctx, path, (const unsigned char *)out->data, kind, format, same_version);
    }
    if (status != FLOE_OK) {
        sealed_free(ctx, out);
        return status;
    }
    out->image = out->data + SEALED_HEADER;
    out->size = size - SEALED_HEADER;
    return FLOE_OK;
}

void sealed_free(context *ctx, sealed_file *file)
{
    memory_free(ctx, &file->data);
    *file = (sealed_file){0};
}
