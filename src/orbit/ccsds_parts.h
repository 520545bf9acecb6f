/* ccsds_parts.h: what the two scanners of CCSDS messages share. */
#ifndef GLINT_ORBIT_CCSDS_PARTS_H
#define GLINT_ORBIT_CCSDS_PARTS_H

#include "orbit/ccsds.h"

/* Appends an item; false when memory is out. */
bool ccsds_append(ccsds_file *file, const ccsds_item *item);
/* Turns letters to capitals in place. */
void ccsds_capitals(char *string);
/* Reads XML into file->items and file->texts. Errors as in ccsds_read. */
glint_status ccsds_scan_xml(const char *bytes, size_t size, ccsds_file *file, glint_errors *errors);

#endif
