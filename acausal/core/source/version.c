/* What the library was compiled from. */
#include "core.h"

#define TEXT(name) #name
#define VALUE(name) TEXT(name)

const char *ac_version(void) { return VALUE(AC_SOURCES); }
