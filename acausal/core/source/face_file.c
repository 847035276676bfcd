/* Find and read the file of a model among the resources that an importer names. */
#include "face.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#define WINDOWS 1
#else
#define WINDOWS 0
#endif

#define FILE_NAME "model.bin"
#define CHUNK ((size_t)1 << 16)

/* Whether a text begins so, in letters of either size. */
static int begins(const char *text, const char *with) {
    for (; *with; text++, with++) {
        if (tolower((unsigned char)*text) != *with) return 0;
    }
    return 1;
}

static int is_drive(const char *text) { return isalpha((unsigned char)text[0]) && text[1] == ':'; }

static int digit(char c) {
    if (!isxdigit((unsigned char)c)) return -1;
    return isdigit((unsigned char)c) ? c - '0' : tolower((unsigned char)c) - 'a' + 10;
}

/* Replace escapes in place; not those of a zero, which would end the text. */
static int unescape(char *text) {
    char *to = text;
    for (; *text; text++) {
        if (*text == '%') {
            const int high = digit(text[1]), low = high < 0 ? -1 : digit(text[2]);
            if (low < 0 || !(high || low)) return 0;
            *to++ = (char)(16 * high + low);
            text += 2;
        } else {
            *to++ = *text;
        }
    }
    *to = 0;
    return 1;
}

/* The path in what follows `file:`; NULL where it is on another machine. */
static const char *without_host(const char *rest) {
    if (rest[0] == '/' && rest[1] == '/') {
        const char *host = rest + 2;
        if (begins(host, "localhost/")) rest = host + strlen("localhost");
        else if (*host == '/') rest = host;
        else if (!WINDOWS) return NULL;
        else if (is_drive(host)) rest = host; /* not as it should be, and met */
    }
    return WINDOWS && rest[0] == '/' && is_drive(rest + 1) ? rest + 1 : rest;
}

/* The path of the model in a folder, named by a path or a URI; NULL where there is none, or no memory. */
char *ac_face_path(const char *resources, int is_uri) {
    const char *folder = resources;
    const int escaped = is_uri && begins(resources, "file:");
    if (escaped) folder = without_host(resources + strlen("file:"));
    else if (is_uri && strstr(resources, "://")) return NULL;
    if (!folder || !*folder) return NULL;
    const size_t length = strlen(folder);
    char *path = malloc(length + sizeof "/" FILE_NAME);
    if (!path) return NULL;
    strcpy(path, folder);
    if (escaped && !unescape(path)) {
        free(path);
        return NULL;
    }
    const char last = path[strlen(path) - 1];
    if (last != '/' && !(WINDOWS && last == '\\')) strcat(path, "/");
    return strcat(path, FILE_NAME);
}

#if defined(_WIN32)
/* Paths are UTF-8, which Windows takes in wide characters alone. */
static FILE *open_file(const char *path) {
    const int length = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, NULL, 0);
    wchar_t *wide = length > 0 ? malloc((size_t)length * sizeof *wide) : NULL;
    if (!wide) return fopen(path, "rb");
    MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, wide, length);
    FILE *file = _wfopen(wide, L"rb");
    free(wide);
    return file;
}
#else
static FILE *open_file(const char *path) { return fopen(path, "rb"); }
#endif

/* All that a file holds; NULL where it cannot be read. A folder opens like a file: only reading tells. */
void *ac_face_bytes(const char *path, size_t *length) {
    FILE *file = open_file(path);
    if (!file) return NULL;
    char *bytes = NULL;
    size_t room = 0;
    for (*length = 0; !feof(file) && !ferror(file);) {
        if (*length == room) {
            char *more = realloc(bytes, room = 2 * room + CHUNK);
            if (!more) break;
            bytes = more;
        }
        *length += fread(bytes + *length, 1, room - *length, file);
    }
    const int whole = feof(file) && !ferror(file);
    fclose(file);
    if (whole) return bytes;
    free(bytes);
    return NULL;
}
