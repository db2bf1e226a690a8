#include "io/hdf_look.h"

#include <string.h>

size_t hdf_entries(hdf_file *file, const char *path)
{
    H5G_info_t info = {0};
    if (!hdf_has(file, path)) return 0;
    return H5Gget_info_by_name(file->id, path, &info, H5P_DEFAULT) < 0 ? 0 : (size_t)info.nlinks;
}

floe_status hdf_entry(hdf_file *file, const char *path, size_t n, char name[HDF_NAME])
{
    const ssize_t length =
        H5Lget_name_by_idx(file->id, path, H5_INDEX_NAME, H5_ITER_INC, n, name, HDF_NAME, H5P_DEFAULT);
    if (length < 0) return hdf_fail(file, "list", path);
    if (length < HDF_NAME) return FLOE_OK;
    return fail(file->ctx, FLOE_IO, "'%s': '%s' holds a name of %zd characters, too long for floe", file->name, path,
                length);
}

/* Opens an attribute; *out is for the caller to close. */
static floe_status open_attribute(hdf_file *file, const char *path, const char *name, hid_t *out)
{
    *out = H5I_INVALID_HID;
    if (H5Aexists_by_name(file->id, path, name, H5P_DEFAULT) <= 0) {
        return fail(file->ctx, FLOE_IO,
                    "'%s': '%s' has no attribute '%s'; if an earlier floe has written it, run the deck again",
                    file->name, path, name);
    }
    *out = H5Aopen_by_name(file->id, path, name, H5P_DEFAULT, H5P_DEFAULT);
    return *out < 0 ? hdf_fail(file, "open an attribute of", path) : FLOE_OK;
}

/* Class and number of elements of an attribute. */
static H5T_class_t attribute_class(hid_t attribute, long long *elements)
{
    const hid_t type = H5Aget_type(attribute);
    const hid_t space = H5Aget_space(attribute);
    const H5T_class_t class = H5Tget_class(type);
    *elements = (long long)H5Sget_simple_extent_npoints(space);
    (void)H5Sclose(space);
    (void)H5Tclose(type);
    return class;
}

static floe_status not_as_expected(hdf_file *file, const char *path, const char *name)
{
    return fail(file->ctx, FLOE_IO, "'%s': the attribute '%s' of '%s' is not of the expected kind", file->name, name,
                path);
}

static floe_status read_attribute(hdf_file *file, const char *path, const char *name, hid_t attribute, int most,
                                  double *value, int *count)
{
    long long elements;
    const H5T_class_t class = attribute_class(attribute, &elements);
    const bool number = class == H5T_FLOAT || class == H5T_INTEGER;
    if (!number || elements < 1 || elements > most) return not_as_expected(file, path, name);
    *count = (int)elements;
    if (H5Aread(attribute, H5T_NATIVE_DOUBLE, value) < 0) return hdf_fail(file, "read an attribute of", path);
    return FLOE_OK;
}

floe_status hdf_get_attribute(hdf_file *file, const char *path, const char *name, int most, double *value, int *count)
{
    hid_t attribute;
    TRY(open_attribute(file, path, name, &attribute));
    const floe_status status = read_attribute(file, path, name, attribute, most, value, count);
    (void)H5Aclose(attribute);
    return status;
}

/* floe's texts are of variable length: HDF5 makes space for them. */
static floe_status read_attribute_text(hdf_file *file, const char *path, const char *name, hid_t attribute, char *to)
{
    long long elements;
    char *text = NULL;
    if (attribute_class(attribute, &elements) != H5T_STRING || elements != 1) return not_as_expected(file, path, name);
    const hid_t type = H5Aget_type(attribute);
    const bool fine = H5Tis_variable_str(type) > 0 && H5Aread(attribute, type, &text) >= 0 && text;
    (void)H5Tclose(type);
    if (!fine) return not_as_expected(file, path, name);
    (void)snprintf(to, HDF_NAME, "%s", text);
    (void)H5free_memory(text);
    return FLOE_OK;
}

floe_status hdf_get_text(hdf_file *file, const char *path, const char *name, char text[HDF_NAME])
{
    hid_t attribute;
    TRY(open_attribute(file, path, name, &attribute));
    const floe_status status = read_attribute_text(file, path, name, attribute, text);
    (void)H5Aclose(attribute);
    return status;
}

floe_status hdf_read_numbers(hdf_file *file, const char *path, size_t n, double *to)
{
    hdf_type type;
    hdf_shape shape;
    TRY(hdf_describe(file, path, &type, &shape));
    if (hdf_count(shape) != n) {
        return fail(file->ctx, FLOE_IO, "'%s': '%s' has %zu numbers instead of %zu", file->name, path, hdf_count(shape),
                    n);
    }
    const hid_t set = H5Dopen2(file->id, path, H5P_DEFAULT);
    const herr_t read = set < 0 ? -1 : H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, to);
    const floe_status status = read < 0 ? hdf_fail(file, "read", path) : FLOE_OK;
    if (set >= 0) (void)H5Dclose(set);
    return status;
}
