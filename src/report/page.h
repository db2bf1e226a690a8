/* A page in progress, and what its sections share. Private to src/study/report. */
#ifndef REPORT_PAGE_H
#define REPORT_PAGE_H

#include "base/strbuf.h"
#include "draw/plot.h"
#include "report/report.h"

struct json_t;

enum { PAGE_PATH = 4096, PAGE_TEXT = 512 };

typedef struct page {
    context *ctx;                  /* not owned */
    const report_options *options; /* not owned */
    strbuf body;                   /* the sections; owned */
    strbuf contents;               /* the table of contents; owned */
    strbuf summary;                /* what comes first; owned */
    char files[PAGE_PATH];         /* folder of the plots */
    int sections;                  /* so far, for names that links refer to */
    int headings;                  /* of this section so far */
    int plots;                     /* so far */
    bool folded;                   /* within a folded box, whose parts the table of contents leaves out */
    bool no_gnuplot;
} page;

/* Starts a section with a title that the table of contents lists. */
void page_section_begin(page *p, const char *title);
void page_section_end(page *p);
/* A title within a section, which the table of contents lists too. */
void page_heading(page *p, const char *title);

/* Draws figures (of one panel each) side by side, each with its title, its data, and `note` (may be NULL) below all.
 * Those without anything to draw are left out. */
floe_status page_figures(page *p, const plot_figure *figure, size_t n);
/* A picture as PNG; not owned. */
typedef struct page_image {
    const void *png;
    size_t size; /* bytes */
} page_image;
/* A picture for light pages and for dark ones, with its caption. */
void page_picture(page *p, const page_image *light, const page_image *dark, const char *caption);

/* A JSON file; the caller owns the reference. NULL in *out, and no failure, when it is not there. */
floe_status page_read_json(page *p, const char *dir, const char *name, struct json_t **out);
/* A text file in counted memory, owned by the caller; NULL when it is not there. */
floe_status page_read_text(page *p, const char *dir, const char *name, char **out);

/* Members of a JSON object, with what stands for those that are missing or of another type. */
double json_number_of(const struct json_t *object, const char *key);    /* NAN */
const char *json_text_of(const struct json_t *object, const char *key); /* "" */

/* The title of what a folder holds. */
floe_status report_title(page *p, const char *dir, char title[PAGE_TEXT]);

/* The sections: each adds its folder's results to the page. */
floe_status report_run(page *p, const char *dir);
floe_status report_compare(page *p, const char *dir);
floe_status report_study(page *p, const char *dir);
floe_status report_stability(page *p, const char *dir);

#endif
