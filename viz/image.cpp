#include "viz/image.h"
