/* Prints fields of a snapshot as text, a line a cell or point, with HDF5 alone: x y z, then the fields.
 *
 *     cc -std=c11 snapshot_to_text.c -o snapshot_to_text $(pkg-config --cflags --libs hdf5-serial)
 *     ./snapshot_to_text fields/000004.h5 cells pressure volume_fraction_gas
 *     ./snapshot_to_text fields/000004.h5 points/cylinder sigma_r sigma_theta
 */
#include <hdf5.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_FIELDS = 16 };

/* A dataset as doubles; the caller frees. NULL if it is not there. */
static double *read_field(hid_t group, const char *name, hsize_t *n)
{
    if (H5Lexists(group, name, H5P_DEFAULT) <= 0) return NULL;
    const hid_t set = H5Dopen2(group, name, H5P_DEFAULT), space = H5Dget_space(set);
    *n = (hsize_t)H5Sget_simple_extent_npoints(space);
    double *data = malloc((size_t)(*n > 0 ? *n : 1) * sizeof *data);
    if (data && H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
        free(data);
        data = NULL;
    }
    H5Sclose(space);
    H5Dclose(set);
    return data;
}

/* An attribute of up to three doubles; returns how many. */
static int read_attribute(hid_t group, const char *name, double value[3])
{
    const hid_t attribute = H5Aopen(group, name, H5P_DEFAULT), space = H5Aget_space(attribute);
    const int n = (int)H5Sget_simple_extent_npoints(space);
    if (n <= 3) H5Aread(attribute, H5T_NATIVE_DOUBLE, value);
    H5Sclose(space);
    H5Aclose(attribute);
    return n;
}

/* Centres of cells: arrays have the axes (z, y, x). */
static double *cell_centres(hid_t group, hsize_t *n)
{
    double lower[3] = {0}, spacing[3] = {0}, cells[3] = {1, 1, 1};
    const int dim = read_attribute(group, "cells", cells);
    read_attribute(group, "lower", lower);
    read_attribute(group, "spacing", spacing);
    for (int a = dim; a < 3; a++) cells[a] = 1;
    const size_t nx = (size_t)cells[0], ny = (size_t)cells[1], nz = (size_t)cells[2];
    double *x = malloc(3 * nx * ny * nz * sizeof *x);
    *n = 3 * nx * ny * nz;
    for (size_t i = 0; x && i < nx * ny * nz; i++) {
        const size_t index[3] = {i % nx, i / nx % ny, i / nx / ny};
        for (int a = 0; a < 3; a++) x[3 * i + a] = a < dim ? lower[a] + spacing[a] * ((double)index[a] + 0.5) : 0.0;
    }
    return x;
}

static int print_group(hid_t group, int is_cells, char **names, int n_names)
{
    double *field[MAX_FIELDS] = {0};
    hsize_t n = 0, size = 0;
    double *x = is_cells ? cell_centres(group, &n) : read_field(group, "position", &n);
    int failed = !x;
    for (int k = 0; k < n_names && !failed; k++) {
        field[k] = read_field(group, names[k], &size);
        failed = !field[k] || size != n / 3;
        if (failed) fprintf(stderr, "no field of one number a %s: %s\n", is_cells ? "cell" : "point", names[k]);
    }
    for (hsize_t i = 0; i < n / 3 && !failed; i++) {
        printf("%.9g %.9g %.9g", x[3 * i], x[3 * i + 1], x[3 * i + 2]);
        for (int k = 0; k < n_names; k++) printf(" %.9g", field[k][i]);
        printf("\n");
    }
    for (int k = 0; k < n_names; k++) free(field[k]);
    free(x);
    return failed;
}

int main(int argc, char **argv)
{
    if (argc < 4 || argc - 3 > MAX_FIELDS) {
        fprintf(stderr, "usage: snapshot_to_text FILE cells|points/BODY FIELD...\n");
        return 2;
    }
    const hid_t file = H5Fopen(argv[1], H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return 1;
    const hid_t group = H5Gopen2(file, argv[2], H5P_DEFAULT);
    int failed = group < 0;
    if (!failed) {
        failed = print_group(group, strcmp(argv[2], "cells") == 0, argv + 3, argc - 3);
        H5Gclose(group);
    }
    H5Fclose(file);
    return failed;
}
