#include "apps/dds/interfaces.h"

#include <arpa/inet.h>
#include <dds/ddsi/ddsi_domaingv.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <stdio.h>

int dds_interface_text(const struct ddsi_sertype* type, int number, char* text, size_t size) {
  const struct ddsi_domaingv* domain = ddsrt_atomic_ldvoidp(&type->gv);
  if (number < 0 || number >= domain->n_interfaces) return 0;
  const struct nn_interface* its = &domain->interfaces[number];
  const int is_ipv6 = its->loc.kind == NN_LOCATOR_KIND_UDPv6;
  char address[INET6_ADDRSTRLEN] = "";
  inet_ntop(is_ipv6 ? AF_INET6 : AF_INET, its->loc.address + (is_ipv6 ? 0 : 12), address,
            sizeof address);
  snprintf(text, size, "%s (%s)", its->name, address);
  return 1;
}
