#include "io/hdf_whole.h"

#include <string.h>

/* What a walk over the links has found. */
typedef struct search {
    size_t size; /* bytes of the file */
    char name[256];
    const char *wrong; /* NULL: nothing yet */
} search;

static const char *wrong_link(H5L_type_t type)
{
    switch (type) {
    case H5L_TYPE_HARD: return NULL;
    case H5L_TYPE_SOFT: return "is a link by name";
    case H5L_TYPE_EXTERNAL: return "is a link into another file";
    default: return "is a link of an unknown kind";
    }
}

/* Where the data lie: of nothing, nowhere; else in one piece of the file. */
static const char *wrong_place(hid_t set, size_t size)
{
    const hid_t space = H5Dget_space(set), type = H5Dget_type(set);
    const hssize_t elements = H5Sget_simple_extent_npoints(space);
    const size_t bytes = H5Tget_size(type);
    const bool varies = H5Tdetect_class(type, H5T_VLEN) != 0 || H5Tdetect_class(type, H5T_REFERENCE) != 0;
    const H5T_class_t class = H5Tget_class(type);
    (void)H5Tclose(type);
    (void)H5Sclose(space);
    if (varies || (class != H5T_FLOAT && class != H5T_INTEGER && class != H5T_STRING))
        return "is no array of numbers and no text";
    if (elements < 0 || bytes == 0 || (size_t)elements > size / bytes)
        return "has more numbers than the file has bytes";
    if (elements == 0) return NULL;
    const size_t length = (size_t)elements * bytes;
    const haddr_t at = H5Dget_offset(set);
    if (at == HADDR_UNDEF || H5Dget_storage_size(set) != length) return "has not all of its numbers in the file";
    return at > size || length > size - at ? "lies beyond the end of the file" : NULL;
}

static const char *wrong_set(hid_t set, size_t size)
{
    const hid_t creation = H5Dget_create_plist(set);
    const H5D_layout_t layout = H5Pget_layout(creation);
    const int external = H5Pget_external_count(creation), filters = H5Pget_nfilters(creation);
    (void)H5Pclose(creation);
    if (layout == H5D_VIRTUAL) return "has its data in other datasets (virtual)";
    if (external != 0) return "has its data in other files (external storage)";
    if (filters != 0) return "goes through filters";
    return layout == H5D_CONTIGUOUS ? wrong_place(set, size) : "is not stored in one piece";
}

static const char *wrong_object(hid_t group, const char *name, size_t size)
{
    const hid_t object = H5Oopen(group, name, H5P_DEFAULT);
    if (object < 0) return "cannot be opened";
    const H5I_type_t kind = H5Iget_type(object);
    const char *wrong = kind == H5I_DATASET ? wrong_set(object, size)
                        : kind == H5I_GROUP ? NULL
                                            : "is neither a group nor a dataset";
    (void)H5Oclose(object);
    return wrong;
}

static herr_t check_link(hid_t group, const char *name, const H5L_info_t *info, void *user)
{
    search *s = user;
    s->wrong = wrong_link(info->type);
    if (!s->wrong) s->wrong = wrong_object(group, name, s->size);
    if (!s->wrong) return 0;
    (void)snprintf(s->name, sizeof s->name, "%s", name);
    return 1;
}

floe_status hdf_check_whole(hdf_file *file, size_t size)
{
    search s = {.size = size};
    if (H5Lvisit(file->id, H5_INDEX_NAME, H5_ITER_INC, check_link, &s) < 0) return hdf_fail(file, "list", "/");
    if (!s.wrong) return FLOE_OK;
    return fail(file->ctx, FLOE_IO, "'%s': '/%s' %s: floe writes nothing of the kind, and does not follow it",
                file->name, s.name, s.wrong);
}
