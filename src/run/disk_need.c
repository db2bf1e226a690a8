#include "run/disk_need.h"

#include "io/reserve.h"
#include "scene/deck_location.h"

#include <math.h>
#include <stdio.h>

/* Bytes of a file over those of the state in it: tables, names, the deck; derived fields of snapshots. Measured over decks of inputs/: snapshots
 * have 0.95 to 1.4 of the state and 60 kB, checkpoints 1.0 to 1.1. */
static const double beside_file = 6.4e4, derived = 1.2;

static double count_snapshots(const scene *s)
{
    const double interval = s->output.interval;
    return isfinite(interval) && interval > 0.0 ? floor(s->time.end / interval * (1.0 + 1e-9)) + 2.0 : 2.0;
}

void disk_need_of(const scene *s, double written, const char *dir, disk_need *out)
{
    const double checkpoints = 3.0;
    *out = (disk_need){.snapshots = count_snapshots(s), .available = disk_free_bytes(dir)};
    out->bytes = out->snapshots * (derived * written + beside_file) + checkpoints * (written + beside_file);
    out->fits = out->bytes <= out->available;
}

void disk_need_remark(const sim *s, const char *dir, remark_sink *say, void *user)
{
    const double gigabyte = 1e9;
    char where[512], text[1024];
    memory_need memory;
    disk_need disk;
    memory_need_of(s, &memory);
    disk_need_of(s->scene, memory.written_bytes, dir, &disk);
    if (disk.fits) return;
    scene_key_place(s->scene, "output.interval", where, sizeof where);
    (void)snprintf(text, sizeof text,
                   "%s%.0f snapshots and three checkpoints take about %.3g GB, and the disk has %.3g GB: take a longer "
                   "interval, or another disk",
                   where, disk.snapshots, disk.bytes / gigabyte, disk.available / gigabyte);
    say(user, text);
}
