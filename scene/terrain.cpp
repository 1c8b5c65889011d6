#include "scene/terrain.h"
