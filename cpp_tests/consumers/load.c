/* A plug-in's host: loads the library by its name and refuses another interface than the one it was compiled with.
 *
 *     load LIBRARY
 */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <taut.h>

int main(int argc, char **argv) {
    void *library = argc == 2 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!library) {
        fprintf(stderr, "load: %s\n", argc == 2 ? dlerror() : "usage: load LIBRARY");
        return 2;
    }
    uint32_t (*abi)(void) = NULL;
    void *symbol = dlsym(library, "taut_abi");
    memcpy(&abi, &symbol, sizeof abi); /* ISO C casts no object pointer to a function */
    uint32_t found = abi ? abi() : 0;
    dlclose(library);
    if (found != TAUT_ABI) {
        fprintf(stderr, "load: %s has the interface %u, not %u\n", argv[1], (unsigned)found, (unsigned)TAUT_ABI);
        return 1;
    }
    return 0;
}
