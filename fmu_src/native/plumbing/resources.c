/* The file of the model among the resources of the FMU. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* for dladdr */
#endif
#include "internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <dlfcn.h>
#endif

enum { LONGEST_PATH = 8192, LARGEST_FILE = 1 << 30 };
static const char NAME[] = "model.bin";

static int digit(char sign)
{
    return sign >= '0' && sign <= '9'   ? sign - '0'
           : sign >= 'a' && sign <= 'f' ? sign - 'a' + 10
           : sign >= 'A' && sign <= 'F' ? sign - 'A' + 10
                                        : -1;
}

/* Whether a text begins so, in small letters or capitals. */
static int begins(const char *text, const char *with)
{
    for (; *with; text++, with++) {
        if (*text != *with && *text != *with - 'a' + 'A') {
            return 0;
        }
    }
    return 1;
}

/* Writes the bytes that a URI stands for; returns how many, or 0 if they are too many. */
static size_t decode(const char *text, char *path, size_t size)
{
    size_t used = 0;
    for (; *text && used < size; text++) {
        char sign = *text;
        if (sign == '%' && digit(text[1]) >= 0 && digit(text[2]) >= 0) {
            sign = (char)(16 * digit(text[1]) + digit(text[2]));
            text += 2;
        }
        path[used++] = sign;
    }
    return *text ? 0 : used;
}

/* Where the path begins in a URI: file:/path, file:///path, file://localhost/path; file:///C:/path
   and file://server/path on Windows. */
static const char *path_of(const char *uri)
{
    const char *path = uri + strlen("file:");
    if (begins(path, "//localhost/")) {
        path += strlen("//localhost");
    } else if (!strncmp(path, "///", 3)) {
        path += 2;
    }
#ifdef _WIN32
    char drive = (char)(path[0] ? path[1] | 0x20 : 0);
    if (path[0] == '/' && drive >= 'a' && drive <= 'z' && (path[2] == ':' || path[2] == '|' ||
                                                           !strncmp(path + 2, "%3", 2))) {
        path++;
    }
#endif
    return path;
}

/* Opens a file for reading; its path is in UTF-8. */
static FILE *opened(const char *path)
{
#ifdef _WIN32
    wchar_t wide[LONGEST_PATH];
    return MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, wide, LONGEST_PATH)
               ? _wfopen(wide, L"rb")
               : NULL;
#else
    return fopen(path, "rb");
#endif
}

/* Opens the model's file in a folder, whose name has `used` signs; 0 if it was too long. */
static FILE *opened_in(char *folder, size_t used)
{
    if (used == 0 || used + sizeof NAME + 1 > LONGEST_PATH) {
        return NULL;
    }
    folder[used] = '/';
    memcpy(folder + used + 1, NAME, sizeof NAME);
    return opened(folder);
}

/* Writes the path of this library; returns how many signs it has, 0 if it is not known. */
static size_t own_path(char *path, size_t size)
{
#ifdef _WIN32
    wchar_t wide[LONGEST_PATH];
    HMODULE library = NULL;
    DWORD flags = GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS |
                  GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
    DWORD found = GetModuleHandleExW(flags, (LPCWSTR)(const void *)NAME, &library)
                      ? GetModuleFileNameW(library, wide, LONGEST_PATH)
                      : 0;
    int used = found && found < LONGEST_PATH
                   ? WideCharToMultiByte(CP_UTF8, 0, wide, (int)found, path, (int)size, NULL, NULL)
                   : 0;
    return (size_t)used;
#else
    Dl_info library;
    if (!dladdr(NAME, &library) || !library.dli_fname) {
        return 0;
    }
    size_t used = strlen(library.dli_fname);
    if (used > size) {
        return 0;
    }
    memcpy(path, library.dli_fname, used);
    return used;
#endif
}

/* Opens the model's file where an FMU has it: two folders above that of this library. */
static FILE *opened_beside_library(char *path)
{
    static const char BESIDE[] = "../../resources";
    size_t used = own_path(path, LONGEST_PATH - sizeof BESIDE);
    while (used && path[used - 1] != '/' && path[used - 1] != '\\') {
        used--;
    }
    memcpy(path + used, BESIDE, sizeof BESIDE);
    return opened_in(path, used + sizeof BESIDE - 1);
}

static unsigned char *content_of(FILE *file, size_t *size)
{
    unsigned char *bytes = NULL;
    long end = fseek(file, 0, SEEK_END) ? -1 : ftell(file);
    if (end > 0 && end <= LARGEST_FILE && !fseek(file, 0, SEEK_SET)) {
        bytes = malloc((size_t)end);
    }
    if (bytes && fread(bytes, 1, (size_t)end, file) != (size_t)end) {
        free(bytes);
        bytes = NULL;
    }
    *size = (size_t)end;
    return bytes;
}

unsigned char *gl_read_model(const char *resources, size_t *size, char why[GL_LONGEST_MESSAGE])
{
    char path[LONGEST_PATH];
    const char *given = resources ? resources : "";
    size_t used = strlen(given);
    if (begins(given, "file:")) {
        used = decode(path_of(given), path, sizeof path);
    } else if (used < sizeof path) {
        memcpy(path, given, used);
    }
    FILE *file = opened_in(path, used);
    if (!file) { /* hosts exist that give another folder, or none */
        file = opened_beside_library(path);
    }
    unsigned char *bytes = file ? content_of(file, size) : NULL;
    if (file) {
        fclose(file);
    }
    if (!bytes) {
        snprintf(why, GL_LONGEST_MESSAGE,
                 "The FMU cannot read its model, the file %s in the folder of its resources. The "
                 "host must unpack the FMU as it is and give that folder, got \"%.600s\".",
                 NAME, given);
    }
    return bytes;
}
