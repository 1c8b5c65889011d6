#include "raster/pass.h"
