#include "texture/perlin.h"
