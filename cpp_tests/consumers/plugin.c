/* A plug-in that exports one function of its own. */
#include <taut.h>

const char *plugin_version(void);
const char *plugin_version(void) { return taut_version(); }
