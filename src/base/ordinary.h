/* Opening files without being led astray: what floe reads or appends to is an ordinary file. A named pipe is refused,
 * not waited for; a device or a socket is not touched. */
#ifndef BASE_ORDINARY_H
#define BASE_ORDINARY_H

#include <sys/types.h>

/* What a mode (of stat) is of: "a folder", "a named pipe", "a device", "a socket", "a symbolic link"; NULL: an ordinary
 * file. */
const char *special_kind(mode_t mode);

/* open() of an ordinary file with these flags of its (0666 where O_CREAT is among them). On failure -1, and *special is
 * what stands there; NULL: errno says why. */
int ordinary_open(const char *path, int flags, const char **special);

/* The same for reading, and what the caller of the program has opened is read whatever it is: /dev/stdin, /dev/fd/N. */
int input_open(const char *path, const char **special);

#endif
