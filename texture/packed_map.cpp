#include "texture/packed_map.h"
