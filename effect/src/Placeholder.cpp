#include <tyndall/tyndall.h>
