/* A checkpoint past its seal: the input is a list of changes of eight-byte numbers, texts and arrays of a sound one, of twelve bytes each,
 * so that HDF5 reads it and floe's own checks are reached. It is taken or refused with a message, nothing is left in memory, and a
 * simulation that took it makes a step or says why not. */
#include "fuzz.h"

#include "base/memory.h"
#include "deck/deck.h"
#include "io/checkpoint/checkpoint.h"
#include "io/io.h"
#include "io/sealed_file.h"
#include "run/catalogue.h"

#include <hdf5.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

enum { MOST_PATHS = 512, MOST_TEXT = 128, CHANGE = 12, MOST_CHANGES = 16 };

static context *ctx;
static scene *the_scene;
static char *image; /* of a sound checkpoint, HDF5's part */
static size_t image_size;
static char path[MOST_PATHS][MOST_TEXT];
static size_t n_paths;

static checkpoint_run a_run(void)
{
    return (checkpoint_run){.deck = "floe: 1\n", .identity = "floe: 1\n"};
}

static void make_scene(void)
{
    static const char *const set[] = {"domain.cell=0.4", "method.basis=gimp", "coupling=ice-mpm", "verify=null",
                                      "method.interface=smeared"};
    deck_catalogue *catalogue;
    deck_report report = {0};
    const deck_overrides overrides = {set, sizeof set / sizeof set[0]};
    fuzz_require(catalogue_create(&catalogue, ctx) == FLOE_OK, "no catalogue");
    fuzz_require(deck_load(&the_scene, ctx, FLOE_SOURCE_DIR "/inputs/pressurized_cylinder.yaml", &overrides, catalogue,
                           &report) == FLOE_OK,
                 report.text ? report.text : context_message(ctx));
    deck_report_free(&report);
    catalogue_destroy(ctx, &catalogue);
}

static void make_image(void)
{
    char file[] = "/tmp/floe_fuzz_XXXXXX";
    const int descriptor = mkstemp(file);
    const checkpoint_run run = a_run();
    sealed_file sealed;
    sim *s;
    fuzz_require(descriptor >= 0 && close(descriptor) == 0, file);
    fuzz_require(sim_create(&s, ctx, the_scene, the_scene->coupling) == FLOE_OK, context_message(ctx));
    for (int i = 0; i < 3; i++) fuzz_require(sim_step(s, INFINITY) == FLOE_OK, context_message(ctx));
    fuzz_require(checkpoint_write(s, file, &run) == FLOE_OK, context_message(ctx));
    fuzz_require(sealed_read(ctx, file, SEALED_CHECKPOINT, 3, true, &sealed) == FLOE_OK, context_message(ctx));
    (void)unlink(file);
    image_size = sealed.size;
    image = malloc(image_size);
    fuzz_require(image != NULL, "no memory");
    memcpy(image, sealed.image, image_size);
    sealed_free(ctx, &sealed);
    sim_destroy(&s);
}

static herr_t note_path(hid_t id, const char *name, const H5O_info_t *info, void *user)
{
    (void)id;
    (void)user;
    if (info->type == H5O_TYPE_DATASET && n_paths < MOST_PATHS) (void)snprintf(path[n_paths++], MOST_TEXT, "/%s", name);
    return 0;
}

/* The image as an HDF5 file in memory that may be changed. */
static hid_t open_image(void)
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    (void)H5Pset_fapl_core(access, 1 << 16, 0);
    (void)H5Pset_file_image(access, image, image_size);
    const hid_t file = H5Fopen("/dev/null/fuzz", H5F_ACC_RDWR, access);
    (void)H5Pclose(access);
    fuzz_require(file >= 0, "the sound checkpoint does not open");
    return file;
}

static void begin(void)
{
    if (ctx) return;
    ctx = context_create();
    deck_init();
    fuzz_require(ctx && io_init(ctx) == FLOE_OK, "no context");
    make_scene();
    make_image();
    const hid_t file = open_image();
    fuzz_require(H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, note_path, NULL) >= 0 && n_paths > 40, "no arrays");
    (void)H5Fclose(file);
}

static double special_number(unsigned which, const uint8_t value[8])
{
    static const double special[] = {NAN, INFINITY, -INFINITY, 0.0, -1.0, 1e300, 1e-300, 1e9, 9007199254740993.0, 0.5};
    double x;
    if (which < sizeof special / sizeof special[0]) return special[which];
    memcpy(&x, value, sizeof x);
    return x;
}

/* Sets one element, of whatever type, to the bits or the value of a number. */
static void set_element(hid_t set, size_t at, double value)
{
    const hid_t type = H5Dget_type(set), space = H5Dget_space(set);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    const size_t bytes = H5Tget_size(type) * (size_t)(n > 0 ? n : 0);
    char *data = malloc(bytes > 0 ? bytes : 1);
    fuzz_require(data != NULL, "no memory");
    if (bytes >= sizeof value && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0) {
        memcpy(data + at % (bytes / sizeof value) * sizeof value, &value, sizeof value);
        (void)H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    }
    free(data);
    (void)H5Sclose(space);
    (void)H5Tclose(type);
}

/* Puts an array of another extent or type, or a text, in place of what is there. */
static void put_other(hid_t file, const char *name, unsigned kind, size_t n, double value)
{
    const hsize_t extent[2] = {n % 600, 1 + n % 3};
    const bool text = kind % 3 == 2;
    if (H5Ldelete(file, name, H5P_DEFAULT) < 0) return;
    const hid_t type = text ? H5Tcopy(H5T_C_S1) : H5Tcopy(kind % 3 ? H5T_STD_I64LE : H5T_IEEE_F64LE);
    if (text) (void)H5Tset_size(type, 1 + n % 300);
    const hid_t space = text ? H5Screate(H5S_SCALAR) : H5Screate_simple(kind < 128 ? 1 : 2, extent, NULL);
    const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (set >= 0) {
        set_element(set, n, value);
        (void)H5Dclose(set);
    }
    (void)H5Sclose(space);
    (void)H5Tclose(type);
}

/* One change: what, of which array, where, and a number. */
static void change(hid_t file, const uint8_t c[CHANGE])
{
    const char *name = path[(c[1] | c[2] << 8) % n_paths];
    const double value = special_number(c[3], c + 4);
    const size_t at = (size_t)c[4] | (size_t)c[5] << 8;
    if (!H5Lexists(file, name, H5P_DEFAULT)) return;
    if (c[0] >= 250) {
        (void)H5Ldelete(file, name, H5P_DEFAULT);
    } else if (c[0] >= 230) {
        put_other(file, name, c[3], at, value);
    } else {
        const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
        if (set < 0) return;
        set_element(set, c[0] == 0 ? at : c[0], value);
        (void)H5Dclose(set);
    }
}

static char *changed_image(const uint8_t *data, size_t size, size_t *bytes)
{
    const hid_t file = open_image();
    for (size_t i = 0; i + CHANGE <= size && i < CHANGE * MOST_CHANGES; i += CHANGE) change(file, data + i);
    (void)H5Fflush(file, H5F_SCOPE_LOCAL);
    const ssize_t length = H5Fget_file_image(file, NULL, 0);
    fuzz_require(length > 0, "the changed checkpoint has no bytes");
    char *out = malloc((size_t)length);
    fuzz_require(out && H5Fget_file_image(file, out, (size_t)length) == length, "no image");
    *bytes = (size_t)length;
    (void)H5Fclose(file);
    return out;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    begin();
    const uint64_t before = memory_read_account(ctx).live_bytes;
    checkpoint_run run = a_run();
    size_t bytes;
    char *changed = changed_image(data, size, &bytes);
    sim *s;
    fuzz_require(sim_create(&s, ctx, the_scene, the_scene->coupling) == FLOE_OK, context_message(ctx));
    floe_status status = checkpoint_decode(s, "fuzzed", changed, bytes, &run);
    free(changed);
    if (status == FLOE_OK) status = sim_step(s, INFINITY);
    fuzz_require(status == FLOE_OK || context_message(ctx)[0], "refused without a message");
    fuzz_require(status != FLOE_INTERNAL, context_message(ctx));
    sim_destroy(&s);
    context_clear(ctx);
    fuzz_require(memory_read_account(ctx).live_bytes == before, "memory is lost");
    return 0;
}
