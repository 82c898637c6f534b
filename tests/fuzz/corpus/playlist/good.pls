[playlist]
File1=a.mp3
Title1=x
NumberOfEntries=1
Version=2
