#include "texture/image_io.h"
