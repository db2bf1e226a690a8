/* Triangles of an STL file, from its bytes: the binary format, or the one in words. Private to the geom module. */
#ifndef GEOM_STL_TEXT_H
#define GEOM_STL_TEXT_H

#include "geom/shape.h"

/* Three corners of each of *n triangles, as the file has them; the caller frees them with memory_free. bytes[size] is 0.
 * `why` says what is wrong with the file, and in which line or triangle; "" if nothing is. */
floe_status stl_read(double (**corner)[3], int *n, context *ctx, const void *bytes, size_t size, char why[SHAPE_WHY]);

#endif
