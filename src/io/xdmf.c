#include "io/xdmf.h"

#include "io/file.h"
#include "io/names.h"

#include <string.h>

void xdmf_begin_time(strbuf *page, long number, double time)
{
    strbuf_append(page, "<Grid Name=\"%06ld\" GridType=\"Collection\" CollectionType=\"Spatial\">\n", number);
    strbuf_append(page, "<Time Value=\"%.17g\"/>\n", time);
}

/* Three numbers of a mesh in the order of XDMF: slowest axis first. */
static void add_numbers(strbuf *page, const double value[3])
{
    strbuf_append(page, "<DataItem Format=\"XML\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"3\">");
    strbuf_append(page, "%.17g %.17g %.17g</DataItem>\n", value[2], value[1], value[0]);
}

void xdmf_begin_cells(strbuf *page, const mesh *m)
{
    /* ParaView shows two-dimensional meshes in the wrong plane, and reads none of one node across. So an unused axis is
     * a cell thick: y about 0; z below 0, so that the points lie on the face that one looks at. */
    double origin[3] = {m->lower[0], -0.5 * m->h[0], -m->h[0]};
    double spacing[3] = {m->h[0], m->h[0], m->h[0]};
    for (int a = 0; a < m->dim; a++) {
        origin[a] = m->lower[a];
        spacing[a] = m->h[a];
    }
    strbuf_append(page, "<Grid Name=\"cells\" GridType=\"Uniform\">\n");
    strbuf_append(page, "<Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"%d %d %d\"/>\n", m->n[2] + 1, m->n[1] + 1,
                  m->n[0] + 1);
    strbuf_append(page, "<Geometry GeometryType=\"ORIGIN_DXDYDZ\">\n");
    add_numbers(page, origin);
    add_numbers(page, spacing);
    strbuf_append(page, "</Geometry>\n");
}

static void add_item(strbuf *page, const xdmf_array *array)
{
    strbuf_append(page, "<DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"8\" Dimensions=\"",
                  array->integer ? "Int" : "Float");
    for (int i = 0; i < array->rank; i++) strbuf_append(page, "%s%zu", i > 0 ? " " : "", array->extent[i]);
    strbuf_append(page, "\">");
    strbuf_append_xml(page, array->file);
    strbuf_append(page, ":");
    strbuf_append_xml(page, array->path);
    strbuf_append(page, "</DataItem>\n");
}

void xdmf_begin_points(strbuf *page, const char *body, const xdmf_array *index, const xdmf_array *position)
{
    strbuf_append(page, "<Grid Name=\"");
    strbuf_append_xml(page, body);
    strbuf_append(page, "\" GridType=\"Uniform\">\n");
    strbuf_append(page, "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%zu\" NodesPerElement=\"1\">\n",
                  index->extent[0]);
    add_item(page, index);
    strbuf_append(page, "</Topology>\n<Geometry GeometryType=\"XYZ\">\n");
    add_item(page, position);
    strbuf_append(page, "</Geometry>\n");
}

void xdmf_add(strbuf *page, const xdmf_array *array)
{
    char unit[NAME_SIZE];
    unit_without_slash(array->unit, unit);
    strbuf_append(page, "<Attribute Name=\"");
    strbuf_append_xml(page, array->name);
    if (strcmp(unit, "1") != 0) {
        strbuf_append(page, " (");
        strbuf_append_xml(page, unit);
        strbuf_append(page, ")");
    }
    strbuf_append(page, "\" AttributeType=\"%s\" Center=\"%s\">\n", array->vector ? "Vector" : "Scalar",
                  array->on_points ? "Node" : "Cell");
    strbuf_append(page, "<Information Name=\"unit\" Value=\"");
    strbuf_append_xml(page, array->unit);
    strbuf_append(page, "\"/>\n<Information Name=\"meaning\" Value=\"");
    strbuf_append_xml(page, array->meaning);
    strbuf_append(page, "\"/>\n");
    add_item(page, array);
    strbuf_append(page, "</Attribute>\n");
}

void xdmf_end(strbuf *page)
{
    strbuf_append(page, "</Grid>\n");
}

floe_status xdmf_write(context *ctx, const char *path, const char *title, const char *times)
{
    strbuf head;
    strbuf_init(&head, ctx);
    strbuf_append(&head, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n");
    strbuf_append(&head, "<Information Name=\"schema\" Value=\"1\"/>\n<Grid Name=\"");
    strbuf_append_xml(&head, title && *title ? title : "floe");
    strbuf_append(&head, "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
    const char *tail = "</Grid>\n</Domain>\n</Xdmf>\n";
    const file_part part[] = {{strbuf_string(&head), head.length}, {times, strlen(times)}, {tail, strlen(tail)}};
    floe_status status = head.status;
    if (status == FLOE_OK) status = file_replace(ctx, path, part, 3);
    strbuf_free(&head);
    return status;
}
