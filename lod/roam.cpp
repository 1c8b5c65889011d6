#include "lod/roam.h"
