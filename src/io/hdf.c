#include "io/hdf.h"

#include "base/memory.h"
#include "io/hdf_driver.h"
#include "io/hdf_whole.h"

#include <string.h>

/* The name under which HDF5 knows a file, which floe opens itself. It looks for a file of that name first, so there must never
 * be one. */
static const char own_name[] = "/dev/null/floe";

typedef struct complaint {
    char text[400];
} complaint;

/* Keeps the innermost entry of HDF5's error stack: the walk starts there. */
static herr_t keep_first(unsigned n, const H5E_error2_t *error, void *user)
{
    complaint *seen = user;
    if (n == 0) (void)snprintf(seen->text, sizeof seen->text, "%s, in %s", error->desc, error->func_name);
    return 0;
}

floe_status hdf_fail(hdf_file *file, const char *doing, const char *path)
{
    complaint seen = {"no reason given"};
    (void)H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &seen);
    return fail(file->ctx, FLOE_IO, "'%s': HDF5 cannot %s '%s': %s", file->name, doing, path, seen.text);
}

size_t hdf_count(hdf_shape shape)
{
    size_t n = 1;
    for (int i = 0; i < shape.rank; i++) {
        if (shape.extent[i] != 0 && n > SIZE_MAX / shape.extent[i]) return SIZE_MAX;
        n *= shape.extent[i];
    }
    return n;
}

floe_status hdf_create(hdf_file *out, new_file *file, uint64_t at)
{
    *out = (hdf_file){.ctx = file->ctx, .name = file->path, .id = H5I_INVALID_HID};
    const hid_t access = hdf_driver_access(file, at);
    out->id = H5Fcreate(own_name, H5F_ACC_TRUNC, H5P_DEFAULT, access);
    (void)H5Pclose(access);
    return out->id < 0 ? hdf_fail(out, "make", out->name) : FLOE_OK;
}

floe_status hdf_finish(hdf_file *file, floe_status so_far)
{
    const herr_t closed = H5Fclose(file->id);
    file->id = H5I_INVALID_HID;
    return so_far == FLOE_OK && closed < 0 ? hdf_fail(file, "finish", "/") : so_far;
}

floe_status hdf_open(hdf_file *out, context *ctx, const char *name, const void *image, size_t size)
{
    *out = (hdf_file){.ctx = ctx, .name = name, .id = H5I_INVALID_HID};
    const hid_t access = hdf_driver_image(image, size);
    (void)H5PLset_loading_state(0); /* no file may have a plug-in loaded */
    out->id = H5Fopen(own_name, H5F_ACC_RDONLY, access);
    (void)H5Pclose(access);
    if (out->id < 0) return hdf_fail(out, "open", name);
    const floe_status status = hdf_check_whole(out, size);
    if (status != FLOE_OK) hdf_close(out);
    return status;
}

void hdf_close(hdf_file *file)
{
    if (file->id >= 0) (void)H5Fclose(file->id);
    file->id = H5I_INVALID_HID;
    memory_free(file->ctx, &file->data);
}

static hid_t file_type(hdf_type type)
{
    return type == HDF_DOUBLE ? H5T_IEEE_F64LE : H5T_STD_I64LE;
}
static hid_t native_type(hdf_type type)
{
    return type == HDF_DOUBLE ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
}

static hid_t make_space(hdf_shape shape)
{
    hsize_t extent[HDF_MAX_RANK];
    for (int i = 0; i < shape.rank; i++) extent[i] = shape.extent[i];
    return shape.rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(shape.rank, extent, NULL);
}

/* Makes a dataset in `space`, its folders on the way, without times of its own: the same data give the same bytes. */
static hid_t make_dataset(hdf_file *file, const char *path, hid_t type, hid_t space)
{
    const hid_t links = H5Pcreate(H5P_LINK_CREATE);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    (void)H5Pset_create_intermediate_group(links, 1);
    (void)H5Pset_obj_track_times(creation, 0);
    (void)H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER); /* everything is written at once */
    const hid_t set = H5Dcreate2(file->id, path, type, space, links, creation, H5P_DEFAULT);
    (void)H5Pclose(creation);
    (void)H5Pclose(links);
    return set;
}

static floe_status write_set(hdf_file *file, const char *path, hid_t type, hid_t memory, hid_t space, const void *data)
{
    const hid_t set = make_dataset(file, path, type, space);
    if (set < 0) return hdf_fail(file, "make", path);
    const herr_t written = H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    const floe_status status = written < 0 ? hdf_fail(file, "write", path) : FLOE_OK;
    (void)H5Dclose(set);
    return status;
}

floe_status hdf_write(hdf_file *file, const char *path, hdf_type type, hdf_shape shape, const void *data)
{
    const hid_t space = make_space(shape);
    if (space < 0) return hdf_fail(file, "shape", path);
    const floe_status status = write_set(file, path, file_type(type), native_type(type), space, data);
    (void)H5Sclose(space);
    return status;
}

bool hdf_has(hdf_file *file, const char *path)
{
    char part[256];
    const size_t length = strlen(path);
    if (length >= sizeof part) return false;
    memcpy(part, path, length + 1);
    /* H5Lexists fails unless each folder on the way exists. */
    for (char *slash = strchr(part + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        if (H5Lexists(file->id, part, H5P_DEFAULT) <= 0) return false;
        *slash = '/';
    }
    return H5Lexists(file->id, part, H5P_DEFAULT) > 0;
}

static floe_status open_set(hdf_file *file, const char *path, hid_t *set)
{
    *set = H5I_INVALID_HID;
    if (!hdf_has(file, path)) return fail(file->ctx, FLOE_IO, "'%s' holds no '%s'", file->name, path);
    *set = H5Dopen2(file->id, path, H5P_DEFAULT);
    return *set < 0 ? hdf_fail(file, "open", path) : FLOE_OK;
}

static bool read_type(hid_t set, hdf_type *type)
{
    const hid_t id = H5Dget_type(set);
    const bool is_double = H5Tequal(id, H5T_IEEE_F64LE) > 0;
    const bool is_integer = H5Tequal(id, H5T_STD_I64LE) > 0;
    (void)H5Tclose(id);
    *type = is_double ? HDF_DOUBLE : HDF_INT64;
    return is_double || is_integer;
}

static bool read_shape(hid_t set, hdf_shape *shape)
{
    hsize_t extent[HDF_MAX_RANK] = {0};
    const hid_t space = H5Dget_space(set);
    const int rank = H5Sget_simple_extent_ndims(space);
    const bool fine = rank >= 0 && rank <= HDF_MAX_RANK && H5Sget_simple_extent_dims(space, extent, NULL) == rank;
    (void)H5Sclose(space);
    *shape = (hdf_shape){.rank = fine ? rank : 0};
    for (int i = 0; i < shape->rank; i++) shape->extent[i] = (size_t)extent[i];
    return fine;
}

floe_status hdf_describe(hdf_file *file, const char *path, hdf_type *type, hdf_shape *shape)
{
    hid_t set;
    TRY(open_set(file, path, &set));
    const bool fine = read_type(set, type) && read_shape(set, shape);
    (void)H5Dclose(set);
    return fine ? FLOE_OK : fail(file->ctx, FLOE_IO, "'%s': '%s' is not an array of floe's", file->name, path);
}

static bool same_shape(hdf_shape a, hdf_shape b)
{
    if (a.rank != b.rank) return false;
    for (int i = 0; i < a.rank; i++) {
        if (a.extent[i] != b.extent[i]) return false;
    }
    return true;
}

floe_status hdf_read(hdf_file *file, const char *path, hdf_type type, hdf_shape shape, void *data)
{
    hdf_type has_type = HDF_DOUBLE;
    hdf_shape has_shape = {0};
    hid_t set;
    TRY(hdf_describe(file, path, &has_type, &has_shape));
    if (has_type != type || !same_shape(has_shape, shape)) {
        return fail(file->ctx, FLOE_IO, "'%s': '%s' has %zu elements of rank %d, where %zu of rank %d are expected",
                    file->name, path, hdf_count(has_shape), has_shape.rank, hdf_count(shape), shape.rank);
    }
    TRY(open_set(file, path, &set));
    const herr_t read = H5Dread(set, native_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    const floe_status status = read < 0 ? hdf_fail(file, "read", path) : FLOE_OK;
    (void)H5Dclose(set);
    return status;
}

static hid_t text_type(size_t size)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    (void)H5Tset_size(type, size);
    (void)H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

floe_status hdf_write_text(hdf_file *file, const char *path, const char *text)
{
    const hid_t type = text_type(strlen(text) + 1);
    const hid_t space = H5Screate(H5S_SCALAR);
    const floe_status status = write_set(file, path, type, type, space, text);
    (void)H5Sclose(space);
    (void)H5Tclose(type);
    return status;
}

/* The bytes of a text dataset, its NUL included; 0 if it is none. */
static size_t text_size(hid_t set)
{
    hdf_shape shape;
    const hid_t type = H5Dget_type(set);
    size_t size = 0;
    if (H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0) size = H5Tget_size(type);
    (void)H5Tclose(type);
    return read_shape(set, &shape) && shape.rank == 0 ? size : 0;
}

static floe_status read_dataset_text(hdf_file *file, const char *path, hid_t set, char **text)
{
    const size_t size = text_size(set);
    if (size == 0) return fail(file->ctx, FLOE_IO, "'%s': '%s' is not a text", file->name, path);
    TRY(memory_new(file->ctx, text, size + 1, 1));
    const hid_t type = text_type(size);
    const herr_t read = H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, *text);
    (void)H5Tclose(type);
    if (read >= 0) return FLOE_OK;
    memory_free(file->ctx, text);
    return hdf_fail(file, "read", path);
}

floe_status hdf_read_text(hdf_file *file, const char *path, char **text)
{
    hid_t set;
    *text = NULL;
    TRY(open_set(file, path, &set));
    const floe_status status = read_dataset_text(file, path, set, text);
    (void)H5Dclose(set);
    return status;
}

static floe_status write_attribute(hdf_file *file, const char *path, const char *name, hid_t type, hid_t memory,
                                   hid_t space, const void *data)
{
    const hid_t object = H5Oopen(file->id, path, H5P_DEFAULT);
    const hid_t attribute = object < 0 ? -1 : H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool fine = attribute >= 0 && H5Awrite(attribute, memory, data) >= 0;
    const floe_status status = fine ? FLOE_OK : hdf_fail(file, "write an attribute of", path);
    if (attribute >= 0) (void)H5Aclose(attribute);
    if (object >= 0) (void)H5Oclose(object);
    return status;
}

floe_status hdf_attribute_text(hdf_file *file, const char *path, const char *name, const char *text)
{
    const hid_t type = text_type(H5T_VARIABLE); /* so that h5py hands out a str, not bytes */
    const hid_t space = H5Screate(H5S_SCALAR);
    const floe_status status = write_attribute(file, path, name, type, type, space, &text);
    (void)H5Sclose(space);
    (void)H5Tclose(type);
    return status;
}

floe_status hdf_attribute(hdf_file *file, const char *path, const char *name, hdf_type type, int count,
                          const void *data)
{
    const hid_t space = make_space((hdf_shape){.rank = count == 1 ? 0 : 1, .extent = {(size_t)count}});
    const floe_status status = write_attribute(file, path, name, file_type(type), native_type(type), space, data);
    (void)H5Sclose(space);
    return status;
}
