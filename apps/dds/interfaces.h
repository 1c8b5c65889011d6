// Which network interfaces a domain of Cyclone DDS takes. In C: the header that has them is no C++.
#pragma once

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

struct ddsi_sertype;

// Writes "eth0 (172.17.0.2)" for interface `number`, from 0 on, of the domain of a type whose topic
// has been made. 0 if there is none of this number.
int dds_interface_text(const struct ddsi_sertype* type, int number, char* text, size_t size);

#ifdef __cplusplus
}
#endif
